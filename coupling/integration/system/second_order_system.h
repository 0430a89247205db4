#pragma once

#include "coupling/integration/system/constraint_jacobian.h"
#include "coupling/integration/system/excitation.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * Solves  A x = f,  A = w_M M + w_B B + w_C C,  for fixed weights; made by SecondOrderSystem::factorise().
 *
 * Where A is condensed to a few leading coordinates N, from which all others follow, an implicit step need not solve
 * for the others before the forces on N are known:
 *
 *     solve_leading(h, f, x)     x_N of A x = M h + f        (then x_N += Y_N p for forces p on N)
 *     solve_following(h, f, x)   the others, of the same equation, from the final x_N.
 */
class LinearSolver
{
public:
  virtual ~LinearSolver()                                                = default;
  virtual void solve(const Eigen::VectorXd &f, Eigen::VectorXd &x) const = 0;

  /// N; empty: there is no such division, and the other two must not be called.
  virtual const std::vector<int> &leading() const;
  virtual void solve_leading(const Eigen::VectorXd &h, const Eigen::VectorXd &f, Eigen::VectorXd &x) const;
  virtual void solve_following(const Eigen::VectorXd &h, const Eigen::VectorXd &f, Eigen::VectorXd &x) const;
};

class SecondOrderSystem;

/// Motion of all local measures u = W^T q at one instant, and the forces conjugate to them.
struct LocalState
{
  double          t = 0.;
  Eigen::VectorXd u, v, a; // [n_u]
  Eigen::VectorXd p;       // [n_u]
  Eigen::VectorXd lambda;  // [n_c] multipliers of ideal joints, p = G^T lambda on their measures

  void resize(const SecondOrderSystem &system); ///< to zero
  void resize(Eigen::Index n_u);                ///< of a system without ideal joints
};

/// A measure that sticks: its rate is u' = rate, and its force p is the unknown.
struct HeldMeasure
{
  int    measure;
  double rate;
};

/// The measures of one force element: its block of dp/du.
struct ForceBlock
{
  int    first_measure, n_measures;
  double size = 0.; ///< of the numbers [m, rad] whose difference the motion is that the force depends on; 0: of u alone
};

/// Numbers in all blocks of dp/du together.
Eigen::Index tangent_size(const std::vector<ForceBlock> &blocks);

enum class GuardCrossing
{
  rising,
  falling
};

/// A switching function that is active now: whose it is, and which transition its zero means.
struct ActiveGuard
{
  std::string name; ///< of the element in the scene
  std::string kind; ///< of the transition
};

/// One mode of the linear base system: s = -zeta omega +- i omega sqrt(1 - zeta^2).
struct SpectrumLine
{
  double omega; ///< [rad/s]
  double zeta;  ///< [1]
};

/**
 * The machine as every integrator and every search for steady states sees it (5.5.2/1):
 *
 *     M q'' + B q' + C q = f_t(t) + W p,     u = W^T q,     g(t, u) = 0,     G = dg/du,
 *     p = p(t, u, u', u'', history) of the elements,     p = G^T lambda of the ideal joints.
 *
 * M, B, C [n x n] and W [n x n_u] are constant; p is nonlinear and block diagonal, a few measures per element, and G
 * [n_c x n_u] is so too, a few rows per joint.  The
 * system alone knows how its matrices are stored and solved with: dense, reduced or sparse.
 */
class SecondOrderSystem
{
public:
  virtual ~SecondOrderSystem() = default;

  // --- linear base system
  virtual int                           size() const                                                        = 0;
  virtual void                          mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const      = 0;
  virtual void                          damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const   = 0;
  virtual void                          stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const = 0;
  virtual std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const                 = 0;
  virtual std::vector<SpectrumLine>     spectrum() const                                                    = 0;
  /// f_t(t) [n].
  virtual const Excitation &excitation() const = 0;
  /// M, B, C as dense matrices [n x n], for integrators that work in the modes of the base system; false: too large.
  virtual bool dense_matrices(Eigen::MatrixXd &M, Eigen::MatrixXd &B, Eigen::MatrixXd &C) const;

  /// M, B, C as sparse matrices [n x n] that are cheap to factorise anew in every step, for systems of many joints;
  /// false: there are no such, and joints are solved condensed to the measures.
  virtual bool sparse_matrices(Eigen::SparseMatrix<double> &M, Eigen::SparseMatrix<double> &B,
                               Eigen::SparseMatrix<double> &C) const;

  // --- local nonlinear forces
  /// W [n x n_u].
  virtual const Eigen::SparseMatrix<double> &directions() const                                             = 0;
  virtual void                               local_force(const LocalState &state, Eigen::VectorXd &p) const = 0;
  /// p [n_u] and  w_u dp/du + w_v dp/dv + w_a dp/da  [n_u x n_u], block diagonal by element.
  /// Rows of held measures are left as they are.
  virtual void local_tangent(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                             Eigen::MatrixXd &dp) const = 0;
  /// p [n_u], dp/du and dp/dv [n_u x n_u], block diagonal by element: only its blocks are written.
  virtual void local_derivatives(const LocalState &state, Eigen::VectorXd &p, Eigen::MatrixXd &dp_du,
                                 Eigen::MatrixXd &dp_dv) const = 0;
  /// The force elements, joints not among them, in the order of local_tangent_blocks().  Default: one of all measures.
  virtual std::vector<ForceBlock> force_blocks() const;
  /// As local_tangent(), of all the n_u^2 numbers only the blocks of dp, column by column, one behind the other; that
  /// of a held measure is zero.  Default: from local_tangent(), from the heap.
  virtual void local_tangent_blocks(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                                    Eigen::VectorXd &blocks) const;
  /// Measures that stick in the branches that are active now; changed by start(), transition(), restore_history().
  virtual const std::vector<HeldMeasure> &held() const;
  /// True: laws follow the branch their history names, smoothly continued beyond its switching point, as is right where
  /// events are located.  False: by the motion itself.
  virtual void follow_history(bool follow) = 0;

  // --- history of the elements: changes on accept() and transition() only
  virtual Eigen::VectorXd save_history() const                          = 0;
  virtual void            restore_history(const Eigen::VectorXd &saved) = 0;
  virtual void            start(const LocalState &state)                = 0;
  virtual void            accept(const LocalState &state)               = 0;

  // --- events
  virtual int           n_guards() const                                                = 0;
  virtual void          guard_values(const LocalState &state, Eigen::VectorXd &g) const = 0;
  virtual GuardCrossing crossing(int i) const                                           = 0;
  virtual ActiveGuard   guard(int i) const                                              = 0;
  virtual void          transition(int i, const LocalState &state)                      = 0;

  // --- ideal joints; most machines have none
  int n_constraints() const { return constraint_rows(constraint_blocks()); }
  /// Rows of g and measures of each joint; local_force() and its derivatives leave these measures alone.
  virtual const std::vector<ConstraintBlock> &constraint_blocks() const;
  /// g [n_c] and G at state.t, state.u.
  virtual void constraints(const LocalState &state, Eigen::VectorXd &g, ConstraintJacobian &G) const;
  /// What g' = G u' + rate and g'' = G u'' + bias have beyond the first terms, [n_c] each.
  virtual void constraint_rates(const LocalState &state, Eigen::VectorXd &rate, Eigen::VectorXd &bias) const;
  /// Somebody looks at the multipliers: those of index 3 carry rounding enlarged by 1/h^2, and are found from g'' = 0
  /// then.
  virtual bool wants_multipliers() const { return false; }
  /// Forces depend on the multipliers of joints (friction in them), which follow from the forces: a start iterates.
  virtual bool forces_need_multipliers() const { return false; }
  /// Joint and direction of row i, for messages: "crank pin, along x".
  virtual std::string constraint_name(int i) const;

  // --- energy
  /// Coordinates without mass that are no motion but states of a law, such as the torque of a motor that follows with a
  /// lag; nothing of M, B, C couples them to others, factorise(w, 0, 0) holds them apart.  They store no energy.
  virtual const std::vector<int> &virtual_coordinates() const;
  /// Energy [J] stored in the elements.
  virtual double local_stored_energy(const LocalState &state) const = 0;
  /// Power [W] that drives feed, prescribed motions of joints among them, and power that all other laws take beyond
  /// what they store; what an integrator does amiss is in neither: ideal joints do no work but that of prescribed
  /// motion.
  virtual void local_power(const LocalState &state, const Eigen::VectorXd &p, double &input,
                           double &dissipated) const = 0;

  /// Name of coordinate i, for messages.
  virtual std::string coordinate_name(int i) const = 0;
};

/// A numerical method failed: where, and by how much.
class ConvergenceFailure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

} // namespace gestell::coupling

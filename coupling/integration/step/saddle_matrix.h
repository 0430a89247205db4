#pragma once

#include "coupling/integration/step/elimination.h"
#include "coupling/integration/system/second_order_system.h"

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace gestell::coupling
{

/// Solution method for the equations of ideal joints.
enum class JointSolver
{
  automatic, ///< the one with fewer multiplications
  condensed, ///< to the measures, dense: cheap for a few dozen of them, cubic cost beyond
  sparse     ///< together with the motion, linear cost in the number of joints
};

/**
 * Newton's matrix of a system with ideal joints, not condensed, for weights w_M, w_B, w_C and f:
 *
 *         [ A - f W p' W^T   -W G^T   -W_h ]
 *     K = [     G W^T           0       0  ] ,     A = w_M M + w_B B + w_C C,     p' = dp/dxi,   G = dg/du,
 *         [     W_h^T           0       0  ]
 *
 * a square matrix of size n + n_c + n_h.  Its unknowns are the motion x [n], f lambda of the joints [n_c] and f p of
 * the sticking measures [n_h]; W_h are their columns of W.  With f of the order of h^2, multipliers have the unit mass
 * times length, and K does not scale with the step.
 *
 * Pivots are searched with K scaled to unit diagonal of its motions and every equation of a joint to unit length in
 * them: a pivot alone then shows whether it is a rounding error.
 *
 * Motions are eliminated before the joints that act on them.  The Schur complement G W^T (A - ...)^-1 W G^T for the
 * joints is positive definite as long as inertia and stiffness dominate, so that no pivoting is needed, and one order
 * with little fill-in (CAMD) remains suitable while G changes.  A coordinate on which very many joints act (a frame)
 * would couple all of them, and is eliminated after them.  KLU (Davis & Palamadai Natarajan, ACM TOMS 37(3), 2010)
 * finds the pivots, Elimination repeats their elimination in every step; an unsymmetric p', as for friction, needs no
 * special case.  Pivots are searched (and memory is allocated) only at first and if the present ones or a step failed.
 */
class SaddleMatrix
{
public:
  /// @throws std::invalid_argument if the system provides no sparse matrices
  explicit SaddleMatrix(const SecondOrderSystem &system);
  ~SaddleMatrix();

  /// The matrix if joints are solved sparse, else null.
  /// @throws std::invalid_argument if `sparse` is required for a system without sparse matrices
  static std::unique_ptr<SaddleMatrix> for_joints(const SecondOrderSystem &system, JointSolver solver);

  /// Sets the sticking measures; K is analysed again if they change.
  void hold(const std::vector<HeldMeasure> &held);
  /// Invalidates the factor if they differ from the previous ones.
  void set_weights(double w_M, double w_B, double w_C, double f);
  void forget_factor() { factorised_ = false; }
  /// The next factorisation searches its pivots again, with memory from the heap.
  void forget_pivots();
  bool has_factor() const { return factorised_; }

  /// @param tangent  p' as local_tangent_blocks() gives it
  /// @return false: singular, see failed()
  bool factorise(const Eigen::VectorXd &tangent, const ConstraintJacobian &G);
  /// After factorise() failed: the row of K that depends on the others.
  int failed() const { return failed_; }

  /// y := K^-1 y, with the factor made last.
  void solve_in_place(Eigen::VectorXd &y) const;

  int                                n_motion() const { return n_; }
  int                                size() const { return int(pattern_.rows()); }
  const Eigen::SparseMatrix<double> &A() const { return A_; }
  /// Multiplications of one factorisation.
  double work() const { return work_; }

private:
  struct PivotSearch;
  struct Scattered
  {
    int    value, position; ///< K[position] += factor weight value
    double weight;
  };

  /// Position in K to which a number is added.
  struct Place
  {
    int    value, row, column;
    double weight;
  };

  /// Numbers of which K is the sum.
  struct Parts
  {
    std::vector<int>       A;                     ///< positions of A's entries
    std::vector<Scattered> tangent, joints, held; ///< -f W p' W^T; -W G^T and G W^T; -W_h and W_h^T
  };

  void                   collect_base(const SecondOrderSystem &system);
  void                   analyse();
  std::vector<Place>     places_of_base() const;
  std::vector<Place>     places_of_tangent() const;
  std::vector<Place>     places_of_joints() const;
  std::vector<Place>     places_of_held() const;
  std::vector<Scattered> scattered(const std::vector<Place> &places) const;
  void                   order();
  int                    position(int row, int column) const;
  void fill(const Parts &parts, const Eigen::VectorXd &tangent, const ConstraintJacobian &G, double *K) const;
  void fill_pattern(const Eigen::VectorXd &tangent, const ConstraintJacobian &G);
  bool find_pivots(const Eigen::VectorXd &tangent, const ConstraintJacobian &G);
  bool eliminate(const Eigen::VectorXd &tangent, const ConstraintJacobian &G);
  bool is_regular(const Eigen::VectorXd &tangent, const ConstraintJacobian &G);

  const SecondOrderSystem     &system_;
  int                          n_, n_c_;
  std::vector<int>             held_; ///< measures
  Eigen::SparseMatrix<double>  A_, pattern_;
  Eigen::VectorXd              M_, B_, C_; ///< entries on the pattern of A
  Eigen::VectorXd              weights_;   ///< w_M, w_B, w_C, f
  Parts                        parts_;     ///< with positions in K
  Parts                        placed_;    ///< with positions in elimination_
  std::vector<int>             diagonal_;  ///< positions of the motions' diagonal in K
  Eigen::VectorXd              square_;    ///< of the factors that scale rows and columns alike
  std::vector<int>             order_;
  std::unique_ptr<Elimination> elimination_; ///< null: its pivots are not known
  Eigen::VectorXd              least_;       ///< magnitudes of pivots above which they are regular without a check
  bool                         factorised_ = false;
  int                          failed_     = 0;
  double                       work_       = 0.;
};

} // namespace gestell::coupling

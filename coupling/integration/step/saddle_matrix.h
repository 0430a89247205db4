#pragma once

#include "coupling/integration/system/second_order_system.h"

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace gestell::coupling
{

/// How the equations of ideal joints are solved.
enum class JointSolver
{
  automatic, ///< by which way has fewer multiplications
  condensed, ///< to the measures, dense: cheap for a few dozen of them, with their cube beyond
  sparse     ///< together with the motion, for as much as the joints are many
};

/**
 * Newton's matrix of a system with ideal joints, not condensed, for weights w_M, w_B, w_C and f:
 *
 *         [ A - f W p' W^T   -W G^T   -W_h ]
 *     K = [     G W^T           0       0  ] ,     A = w_M M + w_B B + w_C C,     p' = dp/dxi,   G = dg/du,
 *         [     W_h^T           0       0  ]
 *
 * [(n + n_c + n_h) x the same].  Its unknowns are the motion x [n], f lambda of the joints [n_c] and f p of the
 * measures that are held [n_h]; W_h are their columns of W.  With f of the order of h^2, multipliers come in units of
 * mass times length and nothing in K scales with the step.
 *
 * Before factorisation K is scaled to unit diagonal of its motions, and so that every equation of a joint has unit
 * length in them: what is rounding is then told by a pivot alone.
 *
 * Motions are eliminated before the joints that act on them.  What is left for these is G W^T (A - ...)^-1 W G^T,
 * positive definite as long as inertia and stiffness rule, so that no pivoting is needed and an order chosen once, for
 * few fill-in (CAMD), serves while G turns.  A coordinate on which very many joints act (a frame) would couple all of
 * them, and comes after them.  KLU (Davis & Palamadai Natarajan, ACM TOMS 37(3), 2010): made for matrices of a few
 * numbers per row, without dense kernels and their overhead; klu_refactor() allocates nothing; unsymmetric p', as
 * friction has, is no other case.  A factor with other pivots is made (and memory taken) only where the kept ones fail
 * or a step did.
 */
class SaddleMatrix
{
public:
  /// @throws std::invalid_argument if the system hands out no sparse matrices
  explicit SaddleMatrix(const SecondOrderSystem &system);
  ~SaddleMatrix();

  /// The matrix if joints are to be solved sparse, else null.
  /// @throws std::invalid_argument if `sparse` is required for a system without sparse matrices
  static std::unique_ptr<SaddleMatrix> for_joints(const SecondOrderSystem &system, JointSolver solver);

  /// Measures that stick; K is analysed again if they change.
  void hold(const std::vector<HeldMeasure> &held);
  /// The factor is void where they are others than before.
  void set_weights(double w_M, double w_B, double w_C, double f);
  void forget_factor() { factorised_ = false; }
  /// The last factorisation no longer guides the pivoting: pivots are searched again, from the heap.
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
  struct Factor;
  struct Scattered
  {
    int    value, position; ///< K[position] += factor weight value
    double weight;
  };

  /// Where a number is added to K.
  struct Place
  {
    int    value, row, column;
    double weight;
  };

  void                   collect_base(const SecondOrderSystem &system);
  void                   analyse();
  std::vector<Place>     places_of_base() const;
  std::vector<Place>     places_of_tangent() const;
  void                   places_of_joints(std::vector<Place> &action, std::vector<Place> &motion) const;
  std::vector<Place>     places_of_held() const;
  std::vector<Scattered> scattered(const std::vector<Place> &places) const;
  void                   order();
  int                    position(int row, int column) const;
  void                   fill(const Eigen::VectorXd &tangent, const ConstraintJacobian &G);
  void                   scale();
  bool                   is_regular();

  const SecondOrderSystem    &system_;
  int                         n_, n_c_;
  std::vector<int>            held_; ///< measures
  Eigen::SparseMatrix<double> A_, pattern_;
  Eigen::VectorXd             M_, B_, C_;                          ///< entries on the pattern of A
  Eigen::VectorXd             weights_;                            ///< w_M, w_B, w_C, f
  std::vector<int>            of_A_;                               ///< positions of A's entries in K
  std::vector<Scattered>      of_tangent_, of_action_, of_motion_; ///< W p' W^T, W G^T, G W^T
  std::vector<Scattered>      of_held_;
  Eigen::VectorXd             scale_; ///< of rows and columns alike
  std::vector<int>            order_;
  std::unique_ptr<Factor>     factor_;
  bool                        factorised_ = false;
  int                         failed_     = 0;
  double                      work_       = 0.;
};

} // namespace gestell::coupling

#pragma once

#include "coupling/integration/step/compliance.h"
#include "coupling/integration/step/plain_matrix.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/small_lu.h"

#include <memory>
#include <vector>

namespace gestell::coupling
{

class StateArchive;

/**
 * Newton's matrix condensed to the measures, bordered by the equations of ideal joints:
 *
 *     delta - S (p' delta + G^T dlambda) = r,     G delta = -g.
 *
 * p' acts only on the measures of force elements, G only on those of joints, and no measure is both.  An element sees
 * its k measures through a few scalars y = L delta, often one (a spring between two bodies in space has up to 24
 * measures):  p' = B L.  Measures on which its law does not depend are in none of them.  Therefore two small matrices
 * are factorised, that of the scalars of all elements and then that of the joints:
 *
 *     y = J^-1 (L r + P_L dlambda),           J = E - L S B           [n_y x n_y],
 *     H dlambda = -g - G r - P_B^T J^-1 L r,  H = G S G^T + P_B^T J^-1 P_L [n_c x n_c],
 *     delta = r + S (B y + G^T dlambda),      P_L = L S G^T,   P_B = B^T S G^T.
 *
 * L, B and G are used in the coordinates on which they act, see Compliance.  S G^T and G S G^T are stored until
 * set_joints() is called again.  For a sticking measure y is S_hh times the change of its force, because S_hh is
 * proportional to h^2: compared with p' = d/h of a damper, a force in its own unit would be mistaken for rounding in
 * short steps.
 *
 * J is kept, over iterations and steps, as long as p' does not change, and H until G is set again.  Nothing allocates
 * after construction.
 */
class CondensedMatrix
{
public:
  CondensedMatrix(const SecondOrderSystem &system, const LoadedCoordinates &loaded);

  /// To be called before factorise() if there are joints, and again if G has changed too much.
  void set_joints(const Compliance &S, const ConstraintJacobian &G);

  /// @param tangent  p' as local_tangent_blocks() gives it
  /// @return false: singular because of the joint failed_joint(), or of the forces if that is -1
  bool factorise(const Compliance &S, const Eigen::VectorXd &tangent, const std::vector<HeldMeasure> &held);

  /// r [n_u] becomes delta, for a sticking measure the change of its force; g [n_c] becomes dlambda.
  void solve_in_place(const Compliance &S, const ConstraintJacobian &G, Eigen::VectorXd &r, Eigen::VectorXd &g);

  /// Whether J is that of S.
  bool is_of(const Compliance &S) const { return kept_S_ == &S; }
  /// What J was made of; J itself is computed again.
  void exchange(StateArchive &archive, const Compliance *S);

  /// The equation that depends on those before it.
  int failed_joint() const { return failed_joint_; }
  /// n_y of the last factorisation.
  int n_scalars() const { return plain_ ? plain_->size() : int(scalars_.size()); }

private:
  /// Measures of an element or joint, and the loaded coordinates that move them.
  struct Block
  {
    int                                   first_measure, n_measures;
    std::vector<int>                      places;                         ///< in N, ascending
    std::vector<LoadedCoordinates::Entry> entries;                        ///< of all measures, by positions in `places`
    std::vector<int>                      begin;                          ///< [n_measures + 1] in entries
    std::size_t                           on_measures = 0, on_places = 0; ///< first numbers of its scalars

    int  n_places() const { return int(places.size()); }
    bool meets(const Compliance::Range &moved) const;
    void to_places(const double *of_measures, double *of_places) const;
    void gather(const double *x, double *own) const;
  };
  /// A row of L with its column of B, or an equation of a joint (L = B).
  struct Scalar
  {
    const Block *block;
    int          measure; ///< it is this measure of the machine; -1: a combination
    bool         held;
    double      *l, *b;     ///< [n_measures of the block]
    double      *l_q, *b_q; ///< [n_places]
  };

  static Block block_of(const LoadedCoordinates &loaded, int first_measure, int n_measures);
  void         add_blocks(const SecondOrderSystem &system, const LoadedCoordinates &loaded);
  void         collect(const Compliance &S, const double *tangent, const std::vector<HeldMeasure> &held);
  bool         collect_combinations(const Block &block, const double *tangent);
  void         collect_measures(const Compliance &S, const Block &block, const double *tangent,
                                const std::vector<HeldMeasure> &held);
  Scalar      &add_scalar(const Block &block, int measure, bool held);
  void multiply(const Scalar *rows, int n, const double *x, const Compliance::Range &moved, double *L_x, double *B_x);
  bool keeps_forces(const Compliance &S, const Eigen::VectorXd &tangent, const std::vector<HeldMeasure> &held) const;
  bool factorise_forces(const Compliance &S, const Eigen::VectorXd &tangent, const std::vector<HeldMeasure> &held);
  void fill_forces(const Compliance &S);
  void border();
  void add_motion(const Compliance &S, const ConstraintJacobian &G, const Eigen::VectorXd &dlambda, Eigen::VectorXd &r);

  std::vector<Block>             force_blocks_, joint_blocks_;
  std::vector<double>            l_, b_, l_q_, b_q_; ///< of all scalars, with room for as many as there are measures
  std::vector<double>            G_q_;               ///< of all equations
  std::vector<Scalar>            scalars_, equations_;
  std::vector<double>            rest_, size_; ///< of the tangent of an element while it is divided
  std::vector<double>            own_;         ///< x on the places of a block
  Eigen::VectorXd                moved_;       ///< [n_N]
  SmallLu                        forces_;      ///< J
  Eigen::MatrixXd                S_G_;         ///< [n_N x n_c] C of the columns G^T
  std::vector<Compliance::Range> S_G_rows_;
  Eigen::MatrixXd                G_S_G_;           ///< [n_c x n_c]
  std::vector<double>            X_, P_;           ///< J^-1 P_L, P_B [n_y x n_c]
  SmallLu                        joints_;          ///< H
  Eigen::VectorXd                y_, p_;           ///< [n_y], [n_u]
  bool                           all_seen_ = true; ///< every measure of forces is a scalar: delta follows without S
  std::unique_ptr<PlainMatrix>   plain_;           ///< J, where measures are the places and the scalars; else null
  int                            failed_joint_ = -1;
  const Compliance              *kept_S_       = nullptr; ///< of J; null: there is none
  Eigen::VectorXd                kept_tangent_;           ///< of J
  std::vector<int>               kept_held_;              ///< sticking measures of J
  bool                           joints_known_ = false;   ///< H belongs to J and G
};

} // namespace gestell::coupling

#pragma once

#include "apps/analysis/life/damage.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::apps
{

/// A line above the damage of every cycle: 1/N(range) <= range^slope / constant.
struct UpperLine
{
  double slope    = 3.;
  double constant = 1.;
};

/**
 * Principal components c_r(t) of the states of a load about their mean, z(t) = mean + sum_r b_r c_r(t), and what bounds
 * the damage of any linear measure x = a.z, docs/theory/life.md (8).
 */
class DamageBounds
{
public:
  /**
   * @param states  [n x samples of `load`]
   * @param gram    [n x n] sum of S_i^T S_i over the points: the norm of the components
   */
  DamageBounds(const Eigen::MatrixXd &states, const LoadSequence &load, const DamageRule &rule,
               const Eigen::MatrixXd &gram);

  const Eigen::MatrixXd &basis() const { return basis_; } ///< b_r [n x components]
  const Eigen::VectorXd &mean() const { return mean_; }   ///< [n]

  /**
   * Upper bound of the damage of one repetition.
   * @param parts   |a.b_r| or another norm of S b_r [components], the stress factor included
   * @param offset  a.mean, from which means are bounded
   */
  double of_linear(const Eigen::Ref<const Eigen::ArrayXd> &parts, double offset) const;

  /// The same for a norm of a stress with a sign that changes at most `changes` times in one repetition of the load;
  /// `offset` is the norm of the mean.
  double of_signed_norm(const Eigen::Ref<const Eigen::ArrayXd> &parts, double offset, double changes) const;

  /**
   * Upper bound of the changes of sign of scalars x_i = a_i.z in one repetition of the load: none in windows of the
   * load in which |x| is larger in the middle than all components can change it.
   * @param parts   a_i.b_r [scalars x components]
   * @param offset  a_i.mean [scalars]
   */
  Eigen::VectorXd sign_changes(const Eigen::MatrixXd &parts, const Eigen::VectorXd &offset) const;

private:
  void   measure(const Eigen::MatrixXd &components, const LoadSequence &load);
  void   divide(const Eigen::MatrixXd &components, const LoadSequence &load);
  double of_powers(const Eigen::Ref<const Eigen::ArrayXd> &parts, double factor, double jumps, double jump) const;

  const DamageRule      *rule_;
  Eigen::MatrixXd        basis_;
  Eigen::VectorXd        mean_;
  std::vector<UpperLine> lines_;
  bool                   least_ = true; ///< the damage is below each line, otherwise below their sum
  Eigen::MatrixXd        powers_;       ///< D_m(c_r)^(1/m) [components x lines]
  Eigen::ArrayXd         largest_;      ///< max |c_r|
  Eigen::ArrayXd         width_;        ///< max c_r - min c_r
  Eigen::MatrixXd        middle_;       ///< c_r in the middle of each window [components x windows]
  Eigen::MatrixXd        change_;       ///< max |c_r - middle| in the window
  Eigen::VectorXd        steps_;        ///< samples of the window times the repetitions of its block
  double                 joints_ = 0.;  ///< transitions between blocks and repetitions
};

} // namespace gestell::apps

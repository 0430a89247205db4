#pragma once

#include "apps/analysis/life/damage/damage.h"

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

/// A change of a history, and how often it happens.
struct SizeCount
{
  double size  = 0.;
  double count = 0.; ///< in one repetition of the load
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

  /**
   * The same for a norm |V| of a stress with a sign, docs/theory/life.md (11).
   * @param offset  norm of the mean
   * @param jumps   |V| before and after each change of sign, added
   */
  double of_signed_norm(const Eigen::Ref<const Eigen::ArrayXd> &parts, double offset,
                        const std::vector<SizeCount> &jumps) const;

  /**
   * The same from cycles of a history that differs by a remainder, docs/theory/life.md (12).
   * @param remainder  its changes
   * @param peak       upper bound of the history
   */
  double of_cycles(const std::vector<Cycle> &cycles, const std::vector<SizeCount> &remainder, double peak) const;

  /// Parts of the windows of possible_sign_changes(), samples [first, end].
  const std::vector<LoadBlock> &short_windows() const { return short_windows_; }
  /// Largest distance of each short window's states from the line between its borders [short windows].
  Eigen::VectorXd bending(const Eigen::Ref<const Eigen::ArrayXd> &parts) const;

  /// Upper bound of the norm of the stress.
  double peak_of_norm(const Eigen::Ref<const Eigen::ArrayXd> &parts, double offset) const;

  /**
   * Samples between which scalars x_i = a_i.z may change sign: windows of the load in the middle of which |x| is not
   * larger than all components can change it and `margin`. Consecutive windows are joined.
   * @param parts   a_i.b_r [scalars x components]
   * @param offset  a_i.mean [scalars]
   */
  std::vector<std::vector<LoadBlock>> possible_sign_changes(const Eigen::MatrixXd &parts, const Eigen::VectorXd &offset,
                                                            const Eigen::VectorXd &margin) const;

private:
  void   measure(const Eigen::MatrixXd &components, const LoadSequence &load);
  void   divide(const Eigen::MatrixXd &components, const LoadSequence &load);
  double of_powers(const Eigen::Ref<const Eigen::ArrayXd> &parts, double factor,
                   const std::vector<SizeCount> &jumps) const;
  template <typename Root>
  double of_roots(double factor, const Root &root) const;

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
  std::vector<LoadBlock> windows_;      ///< samples [first, end], the last one is the first of the next
  std::vector<LoadBlock> short_windows_;
  Eigen::MatrixXd        bend_; ///< max |c_r - line between its borders| [components x short windows]
};

} // namespace gestell::apps

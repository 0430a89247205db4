#pragma once

#include "apps/analysis/life/damage/coarse_load.h"
#include "apps/analysis/life/damage/point_stress.h"
#include "apps/analysis/life/damage/signed_path.h"

namespace gestell::apps
{

/// Upper bounds of the damage of points from coarse loads, docs/theory/life.md (5) to (9).
class PointBounds
{
public:
  /// @param points  whose stresses are the norm of the components
  PointBounds(const PointStresses &stresses, const std::vector<int> &points);

  /// Of coarse loads, each closer than the one before; none: the load has too few samples.
  int n_levels() const { return int(loads_.size()); }
  /**
   * @param rows   a of x = a.z; S of one point below that of another for the signed measure
   * @return one for each row, or for each point; infinite without levels
   */
  Eigen::VectorXd of_rows(const Eigen::MatrixXd &rows, int level);

private:
  double of_linear(Eigen::Index i, const Eigen::VectorXd &norms, const CoarseLoad &load);
  double of_signed(Eigen::Index i, const Eigen::VectorXd &norms, const Eigen::VectorXd &traces, const CoarseLoad &load);
  double of_cycles(double error, double variation, double largest, const std::vector<Cycle> &more = {});

  const PointStresses      &stresses_;
  Eigen::VectorXd           mean_;   ///< of largest and smallest states [n]
  coupling::PrincipalStates states_; ///< about it, without components
  std::vector<CoarseLoad>   loads_;
  double                    most_cycles_ = 0.; ///< half of the samples of one repetition of the load
  Eigen::MatrixXd           histories_;        ///< [chosen x rows], their memory is used again
  SignedPath                path_;
  std::vector<Cycle>        cycles_;
};

} // namespace gestell::apps

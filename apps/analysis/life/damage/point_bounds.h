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
  int             n_levels() const { return int(loads_.size()); }
  Eigen::VectorXd of_points(const std::vector<int> &points, int level);
  /// The closest ones, of each row of a point; infinite without levels.
  Eigen::VectorXd of_rows(const MeasureRows &rows, const PointStress &S);

private:
  void compute_histories(const Eigen::MatrixXd &parts, const Eigen::VectorXd &offset, const CoarseLoad &load);
  Eigen::VectorXd of_rows(const Eigen::MatrixXd &parts, const Eigen::VectorXd &offset, const CoarseLoad &load);
  Eigen::VectorXd of_norms(const Eigen::MatrixXd &parts, const Eigen::VectorXd &offset, const CoarseLoad &load);
  double          of_cycles(double error, double variation, double largest, const std::vector<Cycle> &more = {});

  const PointStresses    &stresses_;
  PrincipalStates         states_; ///< without components
  std::vector<CoarseLoad> loads_;
  double                  most_cycles_ = 0.; ///< half of the samples of one repetition of the load
  Eigen::MatrixXd         histories_;        ///< [chosen x rows], their memory is used again
  SignedPath              path_;
  std::vector<Cycle>      cycles_;
};

} // namespace gestell::apps

#pragma once

#include "apps/analysis/life/damage/point_stress.h"

namespace gestell::apps
{

/// Upper bounds of the damage of points, docs/theory/life.md (7) to (12).
class PointBounds
{
public:
  /// @param points  whose stresses are the norm of the components
  PointBounds(const PointStresses &stresses, const std::vector<int> &points);

  Eigen::VectorXd of_points(const std::vector<int> &points) const;
  /// Of each row of a point.
  Eigen::VectorXd of_rows(const MeasureRows &rows, const Eigen::MatrixXd &S) const;
  /// Closer, of the signed measure, from some of the samples.
  Eigen::VectorXd of_samples(const std::vector<int> &points) const;

private:
  Eigen::VectorXd of_rows(const MeasureRows &rows, const PointStress &parts, const coupling::Stress &offset) const;

  /// |L S b_r|, what bounds |L sigma|, and where its sign may change.
  struct SignedParts
  {
    Eigen::ArrayXd         norms;
    double                 offset = 0.;
    double                 peak   = 0.;
    std::vector<LoadBlock> within;
  };
  std::vector<SignedParts> signed_parts(const Eigen::MatrixXd &S) const;
  double of_samples(const SignedParts &parts, const PointStress &S, const Eigen::MatrixXd &sigma) const;

  const PointStresses      &stresses_;
  DamageBounds              bounds_;
  Eigen::MatrixXd           borders_; ///< states at the borders of the short windows [n x borders]
  std::vector<Eigen::Index> border_;  ///< of each short window the first one; the other follows
};

} // namespace gestell::apps

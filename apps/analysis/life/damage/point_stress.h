#pragma once

#include "apps/analysis/life/damage/damage.h"
#include "apps/analysis/life/damage/stress_measure.h"
#include "coupling/frame/reduced_stress.h"

#include <Eigen/Core>

#include <algorithm>
#include <vector>

namespace gestell::apps
{

using StressRow   = Eigen::Matrix<double, 1, 6>;
using PointStress = Eigen::Matrix<double, 6, Eigen::Dynamic>; ///< S_i [6 x n], sigma = S_i z

/// [6 x 6]: five rows L with |L sigma| = sigma_v, and the trace.
const Eigen::Matrix<double, 6, 6> &von_mises_and_trace();
/// Signed von Mises stress of stresses [samples x 6].
Eigen::VectorXd signed_history(const Eigen::Ref<const Eigen::MatrixXd> &sigma);

/// The stresses of a load at the points of a frame, and the damage that they do.
class PointStresses
{
public:
  /// @throws std::invalid_argument: sizes that do not fit, see worst_points()
  PointStresses(const coupling::ReducedStress &stress, const Eigen::MatrixXd &states, const LoadSequence &load,
                const DamageRule &rule, const DamageSearch &search);

  const Eigen::MatrixXd &states() const { return states_; }
  const LoadSequence    &load() const { return load_; }
  const DamageRule      &rule() const { return rule_; }

  bool is_signed() const { return search_.measure == StressMeasure::signed_von_mises; }
  /// Rows of the linear measure at a point; none for the signed one.
  MeasureRows rows(int point) const;
  /// S_i of points, the factor included, one below the other [6 points x n].
  Eigen::MatrixXd matrices(const std::vector<int> &points) const;
  /// x(t) = a.z(t) of the rows a [samples x rows].
  Eigen::MatrixXd histories(const Eigen::MatrixXd &rows) const { return states_.transpose() * rows.transpose(); }

  double damage(const double *history);

private:
  const coupling::ReducedStress &stress_;
  const Eigen::MatrixXd         &states_;
  const LoadSequence            &load_;
  const DamageRule              &rule_;
  const DamageSearch            &search_;
  std::vector<Cycle>             cycles_;
};

/// Calls `visit` with blocks of `points` that are multiplied together.
template <typename Visit>
void in_blocks_of(Eigen::Index size, const std::vector<int> &points, Visit &&visit)
{
  for (std::size_t first = 0; first < points.size(); first += std::size_t(size))
    visit(std::vector<int>(points.begin() + std::ptrdiff_t(first),
                           points.begin() + std::ptrdiff_t(std::min(points.size(), first + std::size_t(size)))));
}

} // namespace gestell::apps

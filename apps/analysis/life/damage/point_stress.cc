#include "apps/analysis/life/damage/point_stress.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace gestell::apps
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const Eigen::Matrix<double, 6, 6> &von_mises_and_trace()
{
  // sigma_v^2 = (xx - (yy + zz)/2)^2 + 3/4 (yy - zz)^2 + 3 (xy^2 + yz^2 + xz^2)
  static const Eigen::Matrix<double, 6, 6> rows = []
  {
    const double                s = std::sqrt(0.75), r = std::sqrt(3.);
    Eigen::Matrix<double, 6, 6> L = Eigen::Matrix<double, 6, 6>::Zero();
    L.topLeftCorner<2, 3>() << 1., -0.5, -0.5, 0., s, -s;
    L.block<3, 3>(2, 3) = r * Eigen::Matrix3d::Identity();
    L.bottomLeftCorner<1, 3>().setOnes();
    return L;
  }();
  return rows;
}

VectorXd signed_history(const Eigen::Ref<const MatrixXd> &sigma)
{
  const auto           xx = sigma.col(0).array(), yy = sigma.col(1).array(), zz = sigma.col(2).array();
  const Eigen::ArrayXd sigma_v =
      (0.5 * ((xx - yy).square() + (yy - zz).square() + (zz - xx).square()) +
       3. * (sigma.col(3).array().square() + sigma.col(4).array().square() + sigma.col(5).array().square()))
          .sqrt();
  return (xx + yy + zz < -trace_of_rounding * sigma_v).select(-sigma_v, sigma_v);
}

PointStresses::PointStresses(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
                             const DamageRule &rule, const DamageSearch &search)
    : stress_(stress), states_(states), load_(load), rule_(rule), search_(search)
{
  require_valid(load, states.cols());
  require_valid(rule.mean_stress, rule.curve.ratio);
  const std::size_t n = std::size_t(stress.n_points());
  if (states.rows() != stress.mean.cols() || search.counts.size() != n ||
      (!search.directions.empty() && search.directions.size() != n) ||
      (search.distance > 0. && search.position.size() != n))
    throw std::invalid_argument("worst_points: states, directions and positions must fit the " + std::to_string(n) +
                                " points of the stresses.");
}

MeasureRows PointStresses::rows(int point) const
{
  if (is_signed())
    return MeasureRows(0, 6);
  return measure_rows(search_.measure,
                      search_.directions.empty() ? SurfaceDirections{} : search_.directions[std::size_t(point)]);
}

MatrixXd PointStresses::matrices(const std::vector<int> &points) const
{
  MatrixXd S(6 * Index(points.size()), stress_.mean.cols());
  for (std::size_t i = 0; i < points.size(); ++i)
    S.middleRows<6>(6 * Index(i)) = search_.factor * stress_.mean.middleRows<6>(6 * Index(points[i])).cast<double>();
  return S;
}

double PointStresses::damage(const double *history)
{
  count_cycles(history, load_, cycles_);
  return damage_of(cycles_, rule_);
}

} // namespace gestell::apps

#include "apps/analysis/life/damage/plane_search.h"

#include <Eigen/Geometry>

#include <cmath>

namespace gestell::apps
{
namespace
{

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Damage of the normal stress on planes at one point.
class PlanesOfPoint
{
public:
  PlanesOfPoint(MatrixXd sigma, const LoadSequence &load, const DamageRule &rule)
      : sigma_(std::move(sigma)), load_(load), rule_(rule)
  {
  }

  double damage(const Vector3d &n)
  {
    history_ = sigma_ * normal_stress_row(n).transpose();
    count_cycles(history_.data(), load_, cycles_);
    return damage_of(cycles_, rule_);
  }

  /// Turns `n` towards `t` to the largest damage near it; returns this damage.
  double turn(Vector3d &n, const Vector3d &t, double damage_of_n)
  {
    const double     gold      = 0.5 * (std::sqrt(5.) - 1.);
    constexpr double precision = 2e-4; // [rad]: a stress falls with the square of the angle, 4e-8
    const auto       at        = [&](double angle) -> Vector3d { return std::cos(angle) * n + std::sin(angle) * t; };
    double           a = -step_of_planes, b = step_of_planes, left = b - gold * (b - a), right = a + gold * (b - a);
    double           of_left = damage(at(left)), of_right = damage(at(right));
    while (b - a > precision)
    {
      if (of_left > of_right)
      {
        b = right, right = left, of_right = of_left;
        left = b - gold * (b - a), of_left = damage(at(left));
      }
      else
      {
        a = left, left = right, of_left = of_right;
        right = a + gold * (b - a), of_right = damage(at(right));
      }
    }
    const double best = std::max(of_left, of_right);
    if (best <= damage_of_n)
      return damage_of_n;
    n = at(of_left > of_right ? left : right).normalized();
    return best;
  }

private:
  MatrixXd            sigma_; ///< [samples x 6]
  const LoadSequence &load_;
  const DamageRule   &rule_;
  VectorXd            history_;
  std::vector<Cycle>  cycles_;
};

} // namespace

PointDamage on_worst_plane(const coupling::ReducedStress &stress, const MatrixXd &states, const LoadSequence &load,
                           const DamageRule &rule, const DamageSearch &search, const PointDamage &at)
{
  if (search.measure != StressMeasure::critical_plane || !(at.damage > 0.) || !std::isfinite(at.damage))
    return at;
  const MatrixXd S = search.factor * stress.mean.middleRows<6>(6 * Eigen::Index(at.point)).cast<double>();
  PlanesOfPoint  planes(states.transpose() * S.transpose(), load, rule);
  const Vector3d surface =
      search.directions.empty() ? Vector3d::Zero() : search.directions[std::size_t(at.point)].normal;
  Vector3d    n     = plane_normal(at.row);
  PointDamage worst = at;
  if (!surface.isZero())
    worst.damage = planes.turn(n, surface.cross(n), at.damage);
  else
  {
    constexpr double settled = 1e-6; // of the damage: far below every other error of a life
    double           before;
    do
    {
      before           = worst.damage;
      const Vector3d u = n.unitOrthogonal(), v = n.cross(u);
      worst.damage = planes.turn(n, u, worst.damage);
      worst.damage = planes.turn(n, v, worst.damage);
    } while (worst.damage > (1. + settled) * before);
  }
  worst.row = normal_stress_row(n);
  return worst;
}

} // namespace gestell::apps

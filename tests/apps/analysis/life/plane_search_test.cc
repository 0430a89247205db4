// The plane of the largest damage between the planes of the search.

#include "apps/analysis/life/damage/plane_search.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

#include <random>

namespace gestell::tests
{
namespace
{

using namespace apps;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

coupling::Stress six(const Matrix3d &S)
{
  return (coupling::Stress() << S(0, 0), S(1, 1), S(2, 2), S(0, 1), S(1, 2), S(0, 2)).finished();
}

/// One point with a stress for each coordinate.
struct OnePoint
{
  coupling::ReducedStress stress;
  DamageSearch            search;

  OnePoint(const std::vector<Matrix3d> &parts, const Vector3d &normal)
  {
    stress.mean.resize(6, Eigen::Index(parts.size()));
    for (std::size_t j = 0; j < parts.size(); ++j)
      stress.mean.col(Eigen::Index(j)) = six(parts[j]).cast<float>();
    stress.point  = {0};
    stress.nearby = {-1};
    search.counts = {1};
    search.directions.assign(1, {normal, Vector3d::Zero()});
  }

  PointDamage worst(const MatrixXd &states, const DamageRule &rule) const
  {
    const LoadSequence load = single_load(states.cols(), Residue::repeated);
    return on_worst_plane(stress, states, load, rule, search, point_damage(stress, states, load, rule, search, 0));
  }
};

DamageRule rule()
{
  return {crane_curve(80e6, 3., StressKind::direct, 1.), {}, Miner::original};
}

/// Blows that ring, of two coordinates out of phase.
MatrixXd states()
{
  MatrixXd z(2, 400);
  for (int k = 0; k < z.cols(); ++k)
  {
    const double t = 2. * M_PI * k / 400.;
    z.col(k) << std::sin(3. * t) + 0.2 * std::sin(17. * t), 0.4 * std::cos(3. * t + 0.3);
  }
  return 100e6 * z;
}

/// The damage of a tension along e is that of its size, whatever e is.
TEST(PlaneOfLargestDamage, OfATensionIsPerpendicularToIt)
{
  std::srand(3);
  const MatrixXd z       = states().topRows(1);
  const VectorXd history = z.row(0);
  const double   exact   = damage_of(count_cycles(history, single_load(z.cols(), Residue::repeated)), rule());
  for (int k = 0; k < 20; ++k)
  {
    const Vector3d e = Vector3d::Random().normalized();
    for (const Vector3d &normal : {Vector3d(e.unitOrthogonal()), Vector3d(Vector3d::Zero())})
    {
      const PointDamage worst = OnePoint({e * e.transpose()}, normal).worst(z, rule());
      // single precision of the stress, and 3 sin^2 of the precision of the angle
      EXPECT_NEAR(worst.damage / exact, 1., 1e-6);
      EXPECT_NEAR(std::abs(plane_normal(worst.row).dot(e)), 1., 1e-6);
    }
  }
}

/// A rotated copy of stress and surface has the same damage.
TEST(PlaneOfLargestDamage, DoesNotDependOnTheOrientationOfTheFrame)
{
  std::srand(8);
  const auto in_plane = [](double xx, double yy, double xy)
  { return (Matrix3d() << xx, xy, 0., xy, yy, 0., 0., 0., 0.).finished(); };
  const std::vector<Matrix3d> parts{in_plane(1., 0.2, 0.3), in_plane(-0.2, 0.5, 0.4)};
  const double                here = OnePoint(parts, Vector3d::UnitZ()).worst(states(), rule()).damage;
  for (int k = 0; k < 20; ++k)
  {
    const Matrix3d        R = Eigen::Quaterniond(Eigen::Vector4d::Random().normalized()).toRotationMatrix();
    std::vector<Matrix3d> rotated;
    for (const Matrix3d &part : parts)
      rotated.push_back(R * part * R.transpose());
    for (const Vector3d &normal : {Vector3d(R.col(2)), Vector3d(Vector3d::Zero())})
      // single precision; without a surface the search ends when a turn gains less than 1e-6
      EXPECT_NEAR(OnePoint(rotated, normal).worst(states(), rule()).damage / here, 1., 1e-5);
  }
}

} // namespace
} // namespace gestell::tests

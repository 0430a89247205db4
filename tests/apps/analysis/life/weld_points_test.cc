// Hot spots of welds: polynomials on an L of two walls are extrapolated exactly.

#include "apps/analysis/life/weld_points.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <functional>

namespace gestell::tests
{
namespace
{

using apps::LifeSkin;
using apps::WeldRequest;

constexpr int    n       = 10;  // intervals of a wall
constexpr double spacing = 0.1; // [m]

/// A floor z = 0 and a wall x = 0, of 1 m x 1 m, that meet in the line x = z = 0; s_xx = field(x) on the floor, zero on
/// the wall.  The line belongs to both.
struct Corner
{
  LifeSkin                                    skin;
  coupling::ReducedStress                     stress;
  std::map<std::string, fem::SurfaceSelector> surfaces;

  explicit Corner(const std::function<double(double)> &field)
  {
    for (int i = -n; i <= n; ++i) // i < 0: up the wall
      for (int j = 0; j <= n; ++j)
        skin.position.emplace_back(spacing * std::max(i, 0), spacing * j, spacing * std::max(-i, 0));
    const auto point = [](int i, int j) { return (i + n) * (n + 1) + j; };
    for (int i = -n; i < n; ++i)
      for (int j = 0; j < n; ++j)
      {
        skin.triangles.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
        skin.triangles.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
      }
    skin.size = 1.7;
    skin.directions.resize(skin.position.size());
    stress.mean = Eigen::MatrixXf::Zero(6 * Eigen::Index(skin.position.size()), 1);
    for (std::size_t k = 0; k < skin.position.size(); ++k)
    {
      stress.point.push_back(int(k));
      stress.nearby.push_back(-1);
      if (skin.position[k].z() == 0.)
        stress.mean(6 * Eigen::Index(k), 0) = float(field(skin.position[k].x()));
    }
    surfaces["floor"].plane = {{0., 0., 1.}, {0., 0., 0.}};
    surfaces["wall"].plane  = {{1., 0., 0.}, {0., 0., 0.}};
    surfaces["far"].plane   = {{0., 0., 1.}, {0., 0., 3.}};
  }

  apps::WeldPoints points(const WeldRequest &weld) const { return weld_points(weld, surfaces, stress, skin); }
};

WeldRequest line(double thickness, const std::vector<double> &distances)
{
  WeldRequest weld;
  weld.name      = "seam";
  weld.surfaces  = {"floor", "wall"};
  weld.thickness = thickness;
  weld.distances = distances;
  weld.place     = "scene.toml:7: life.weld[1]";
  return weld;
}

TEST(WeldPoints, HotSpotsOfPolynomialsAreTheirValuesAtTheLine)
{
  constexpr double single = 1e-5; // some tens of roundings of 6e-8
  const auto       check  = [&](const WeldRequest &weld, const std::function<double(double)> &field, double expected)
  {
    const auto found = Corner(field).points(weld);
    ASSERT_EQ(found.position.size(), std::size_t(n + 1));
    for (int i = 0; i <= n; ++i)
    {
      EXPECT_NEAR(found.stress.mean(6 * i, 0), expected, single);
      EXPECT_NEAR(found.directions[std::size_t(i)].normal.z(), 1., single);
      EXPECT_NEAR(std::abs(found.directions[std::size_t(i)].weld.y()), 1., single);
    }
  };
  check(
      line(1., {0.4, 1.}), [](double x) { return 3. - 2. * x; }, 3.);
  check(
      line(0.5, {0.5, 1.5}), [](double x) { return 3. - 2. * x; }, 3.); // inside triangles
  check(
      line(0.5, {0.4, 0.8, 1.6}), [](double x) { return 3. - 2. * x + 5. * x * x; }, 3.);
  // the published factors, of a step that no line describes
  check(
      line(1., {0.4, 1.}), [](double x) { return x > 0.7 ? 6. : 3.; }, 5. / 3. * 3. - 2. / 3. * 6.);
  check(
      line(0., {}), [](double x) { return 3. - 2. * x; }, 3.); // at the line itself
}

/// Elements of 0.1 m resolve 0.4 t of 1 m, not of 0.15 m; the line itself is a re-entrant corner.
TEST(WeldPoints, AreDoubtfulOnACoarseMeshAndInACorner)
{
  const Corner corner([](double) { return 1.; });
  using Words = std::vector<std::string>;
  EXPECT_EQ(corner.points(line(1., {0.4, 1.})).doubts, Words{});
  EXPECT_EQ(corner.points(line(0.15, {0.4, 1.})).doubts,
            Words{"life: the weld 'seam' is extrapolated from elements of 100 mm, too large for its distances; use "
                  "elements of 60 mm there, or larger distances (IIW)"});
  const Words singular = corner.points(line(0., {})).doubts;
  ASSERT_EQ(singular.size(), 1u);
  EXPECT_NE(singular.front().find("re-entrant corner"), std::string::npos);
}

/// A floor of the width 1 m - y/2 reaches 0.72 m from the line up to y = 0.5 m.
TEST(WeldPoints, PartsWhereTheSurfaceIsTooNarrowAreNamed)
{
  Corner corner([](double) { return 1.; });
  for (Eigen::Vector3d &x : corner.skin.position)
    x.x() *= 1. - 0.5 * x.y();
  const auto found = corner.points(line(0.72, {0.4, 1.}));
  EXPECT_EQ(found.position.size(), 6u);
  ASSERT_EQ(found.doubts.size(), 1u);
  EXPECT_EQ(
      found.doubts.front(),
      "life: the weld 'seam' is not assessed at 5 of 11 points, between (0 0.6 0) and (0 1 0): "
      "'floor' is narrower there than 720 mm; give smaller 'distances', or assess this part as a weld of its own");
}

/// `direction` turns the stress, not the extrapolation, which goes away from the line.
TEST(WeldPoints, AnObliqueStressIsExtrapolatedPerpendicularToTheLine)
{
  WeldRequest oblique = line(1., {0.4, 1.});
  oblique.direction   = {3., 4., 0.};
  const auto found    = Corner([](double x) { return 3. - 2. * x; }).points(oblique);
  ASSERT_EQ(found.position.size(), std::size_t(n + 1));
  constexpr double single = 1e-5;
  for (int i = 0; i <= n; ++i)
  {
    const auto &there = found.directions[std::size_t(i)];
    EXPECT_NEAR(found.stress.mean(6 * i, 0), 3., single);
    EXPECT_NEAR(std::abs(there.normal.cross(there.weld).dot(Eigen::Vector3d(0.6, 0.8, 0.))), 1., single);
  }
}

TEST(WeldPoints, AWeldThatMatchesNothingIsRefused)
{
  const Corner corner([](double) { return 1.; });
  WeldRequest  apart = line(0., {});
  apart.surfaces     = {"floor", "far"};
  expect_refusal([&] { corner.points(apart); },
                 "scene.toml:7: life.weld[1]: the weld 'seam' matches no point of the skin "
                 "('floor' has 121 points, 'far' has 0 points); name two surfaces that meet");
  expect_refusal([&] { corner.points(line(2., {0.4, 1.})); }, "the first of which extends 2000 mm beyond the line");
}

} // namespace
} // namespace gestell::tests

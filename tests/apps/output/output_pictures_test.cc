#include "apps/output/interactive/machine_animation.h"
#include "apps/output/pictures/machine_state.h"
#include "apps/output/pictures/mechanism_shapes.h"
#include "apps/output/pictures/skin.h"
#include "tests/support/output_example.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

using namespace gestell;
using namespace gestell::apps;
using Eigen::Vector3d;

namespace
{

/// Volume enclosed by a surface of triangles; positive if their outside is counter-clockwise.
double volume_of(const Shape &shape)
{
  double v = 0.;
  for (const auto &t : shape.triangles)
    v += shape.points[t[0]].dot(shape.points[t[1]].cross(shape.points[t[2]])) / 6.;
  return v;
}

/// Faces of a unit cube, each divided into n x n squares.
Skin cube(int n)
{
  Skin skin;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {0., 1.})
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
        {
          Vector3d x;
          x[axis]           = side;
          x[(axis + 1) % 3] = i / static_cast<double>(n);
          x[(axis + 2) % 3] = j / static_cast<double>(n);
          if (i < n && j < n)
          {
            const int here = static_cast<int>(skin.points.size()), next = here + n + 1;
            if (side == 1.)
              skin.triangles.insert(skin.triangles.end(), {{here, next, next + 1}, {here, next + 1, here + 1}});
            else
              skin.triangles.insert(skin.triangles.end(), {{here, next + 1, next}, {here, here + 1, next + 1}});
          }
          skin.points.push_back(x);
        }
  skin.displacement.assign(skin.points.size(), Vector3d::UnitX());
  return skin;
}

const Shape &shape_named(const std::vector<Shape> &shapes, const std::string &name)
{
  return *std::find_if(shapes.begin(), shapes.end(), [&](const Shape &shape) { return shape.name == name; });
}

Vector3d centre(const Shape &shape)
{
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d &x : shape.points)
    sum += x;
  return sum / static_cast<double>(shape.points.size());
}

Eigen::Vector4d state(double sway, double lift, double angle, double way)
{
  return {sway, lift, angle, way};
}

} // namespace

TEST(Differences, OfABarAreThoseOfItsEndsHoweverItHasTurnedAboutItsAxis)
{
  Scenery scenery;
  scenery.bars.emplace_back().name = "rope";
  Shape before, after;
  before.name = after.name = "rope";
  add_bar(before, {0., 0., 0.}, {0., 0., 1.}, 0.02);
  before.displacement.assign(before.points.size(), Eigen::Vector3d::Zero());
  after = before;
  for (Eigen::Vector3d &x : after.points)
    x = Eigen::Vector3d(-x[1] + 1e-3 * x[2], x[0], x[2]); // a quarter turn, and its upper end aside
  const auto moved = differences(scenery, {before}, {after});
  for (std::size_t j = 0; j < before.points.size(); ++j)
    EXPECT_NEAR((moved[0][j] - Eigen::Vector3d(before.points[j][2] > 0.5 ? 1e-3 : 0., 0., 0.)).norm(), 0., 1e-12) << j;
}

TEST(MechanismShapes, AreClosedAndLookOutwards)
{
  const auto shapes = mechanism_shapes(example_result().scenery, state(0., 0., 0.7, 0.02));
  ASSERT_EQ(shapes.size(), 3u);
  const double disc = 18. * std::sin(M_PI / 18.) * 0.3 * 0.3 * 0.25 * 0.3; // 36 corners, a quarter of the radius wide
  const double rib  = 0.3 * (0.18 * 0.3) * (2. * 0.25 * 0.3);
  EXPECT_NEAR(volume_of(shape_named(shapes, "crank")), disc + rib, 1e-12);
  EXPECT_NEAR(volume_of(shape_named(shapes, "slide")), 0.5 * 0.4 * 0.3, 1e-12);
  EXPECT_GT(volume_of(shape_named(shapes, "rod")), 0.);
}

TEST(MechanismShapes, SlideStandsWhereTheCrankDrivesItAndCarriesTheRestAsDisplacement)
{
  const Scenery scenery = example_result().scenery;
  const double  r = 0.1, l = 0.8, phi = 2.1;
  const double  u      = -r * std::cos(phi) + std::sqrt(l * l - std::pow(r * std::sin(phi), 2)) - (l - r);
  const double  play   = 3e-4;
  const auto    shapes = mechanism_shapes(scenery, state(1e-4, 2e-4, phi, u + play));

  const Shape &slide = shape_named(shapes, "slide");
  EXPECT_LT((centre(slide) - Vector3d(0.5, 0.5, 1.2 - u)).norm(), 1e-12);
  for (const Vector3d &d : slide.displacement)
    EXPECT_LT((d - Vector3d(0., 0., -play)).norm(), 1e-12);
  for (const Vector3d &d : shape_named(shapes, "crank").displacement)
    EXPECT_LT((d - Vector3d(1e-4, 0., 2e-4)).norm(), 1e-12);
}

TEST(MechanismShapes, RodKeepsItsLengthAndItsPinIsOnTopAtDeadCentre)
{
  const Scenery scenery = example_result().scenery;
  for (const double phi : {0., 0.5, M_PI / 2., 2., M_PI, 5.})
  {
    const Shape rod    = shape_named(mechanism_shapes(scenery, state(0., 0., phi, 0.)), "rod");
    const auto  middle = [&](std::vector<int> corners)
    {
      Vector3d sum = Vector3d::Zero();
      for (const int i : corners)
        sum += 0.25 * rod.points[i];
      return sum;
    };
    const Vector3d pin = middle({0, 3, 4, 7}), small_end = middle({1, 2, 5, 6});
    EXPECT_NEAR((pin - small_end).norm(), 0.8, 1e-12);
    // About +y from +z: towards +x.
    EXPECT_LT((pin - Vector3d(0.5 + 0.1 * std::sin(phi), 0.5, 2. + 0.1 * std::cos(phi))).norm(), 1e-12) << phi;
    EXPECT_NEAR(small_end[0], 0.5, 1e-12);
  }
}

TEST(MechanismShapes, BodiesOfNoSizeAreLeftOut)
{
  Scenery scenery          = example_result().scenery;
  scenery.bodies[0].radius = 0.;
  scenery.bodies[1].size   = {};
  scenery.rods.clear();
  EXPECT_TRUE(mechanism_shapes(scenery, state(0., 0., 0., 0.)).empty());
}

TEST(CoarseMesh, KeepsPlanesAndIsMuchSmaller)
{
  const Skin       fine   = cube(20);
  const CoarseMesh coarse = coarse_mesh(fine, 0.3);
  EXPECT_LT(coarse.triangles.size(), fine.triangles.size() / 10);
  for (const auto &t : coarse.triangles)
  {
    // All three corners on one face of the cube.
    Vector3d low = Vector3d::Ones(), high = Vector3d::Zero();
    for (const int i : t)
    {
      low  = low.cwiseMin(fine.points[coarse.points[i]]);
      high = high.cwiseMax(fine.points[coarse.points[i]]);
    }
    EXPECT_EQ((high - low).minCoeff(), 0.);
  }
  EXPECT_TRUE(coarse_mesh(Skin(), 0.3).points.empty());
}

TEST(Skin, SharpEdgesOfACubeAreItsTwelve)
{
  Skin skin;
  for (const double z : {0., 1.})
    for (const auto &[x, y] : {std::pair(0., 0.), {1., 0.}, {1., 1.}, {0., 1.}})
      skin.points.emplace_back(x, y, z);
  skin.displacement.assign(8, Vector3d::Zero());
  skin.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}};
  for (int i = 0; i < 4; ++i)
    skin.triangles.insert(skin.triangles.end(), {{i, (i + 1) % 4, (i + 1) % 4 + 4}, {i, (i + 1) % 4 + 4, i + 4}});
  EXPECT_EQ(sharp_edges(skin, 35.).size(), 12u);
  EXPECT_EQ(sharp_edges(skin, 95.).size(), 0u);
}

/// The page of a fine mesh stays small, and what is left of the skin moves as it did.
TEST(MachineAnimation, DrawsAFineSkinOnFewTriangles)
{
  const Skin fine = cube(120); // 172 800 triangles
  Result     result;
  for (const Vector3d &x : fine.points)
    result.scenery.points.push_back({x[0], x[1], x[2]});
  result.scenery.triangles    = fine.triangles;
  result.scenery.n_frame      = 1;
  result.scenery.displacement = [&](const Eigen::VectorXd &p) -> Eigen::VectorXd
  {
    Eigen::VectorXd u(3 * static_cast<long>(fine.points.size()));
    for (std::size_t i = 0; i < fine.points.size(); ++i)
      u.segment<3>(3 * static_cast<long>(i)) = p[0] * fine.points[i]; // grows about a corner
    return u;
  };
  const MachineAnimation machine(result);
  ASSERT_TRUE(machine.has_frame());
  const Shape &skin = machine.parts().front();
  EXPECT_LE(skin.triangles.size(), 6500u);
  EXPECT_GT(skin.triangles.size(), 1000u);
  const Eigen::VectorXd mode = machine.frame_mode(Eigen::VectorXd::Constant(1, 0.5)).front();
  for (std::size_t i = 0; i < skin.points.size(); ++i)
    EXPECT_EQ(mode.segment<3>(3 * static_cast<long>(i)), 0.5 * skin.points[i]);
}

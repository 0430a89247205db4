// Frames, points, planar bodies, bars and pins as they are drawn.

#include "apps/output/interactive/machine_animation.h"
#include "apps/output/pictures/machine_state.h"
#include "apps/output/pictures/mechanism_shapes.h"
#include "apps/output/pictures/skin.h"
#include "tests/support/output_example.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

using namespace gestell;
using namespace gestell::apps;
using Eigen::Vector3d;

namespace
{

double volume(const Shape &shape)
{
  double v = 0.;
  for (const auto &t : shape.triangles)
    v += shape.points[t[0]].dot(shape.points[t[1]].cross(shape.points[t[2]])) / 6.;
  return v;
}

/// Sum of the areas as vectors: zero for a closed surface.
Vector3d open_area(const Shape &shape)
{
  Vector3d area = Vector3d::Zero();
  for (const auto &t : shape.triangles)
    area += 0.5 * (shape.points[t[1]] - shape.points[t[0]]).cross(shape.points[t[2]] - shape.points[t[0]]);
  return area;
}

const Shape &named(const std::vector<Shape> &shapes, const std::string &name)
{
  return *std::find_if(shapes.begin(), shapes.end(), [&](const Shape &shape) { return shape.name == name; });
}

Vector3d middle(const Shape &shape)
{
  Eigen::AlignedBox3d box;
  for (const Vector3d &x : shape.points)
    box.extend(x);
  return box.center();
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

constexpr double arm = 2., radius = 0.1;

/// A frame of one coordinate, lift in z; a boom in the x-z plane about -y, its centre of mass 2 m from the pivot at the
/// origin, and a load below its head; a rope between them, a cylinder from the frame to the boom's centre, a pin at the
/// pivot.  q = (lift, boom x, boom z, boom angle, load x, y, z).
Scenery crane()
{
  using mechanism::Placement;
  Scenery scenery;
  scenery.n_frame = 1;
  scenery.interfaces.push_back({"frame.deck", {{{}, {}, {{0, 1.}}}}, {}});
  scenery.interface_positions.emplace_back("deck", std::array<double, 3>{0., 0., -1.});

  coupling::Body boom;
  boom.name                  = "boom";
  boom.kind                  = coupling::BodyKind::planar;
  boom.coordinate            = 1;
  boom.axis                  = {0., -1., 0.};
  boom.e_1                   = {1., 0., 0.};
  boom.e_2                   = {0., 0., 1.};
  boom.position              = {arm, 0., 0.};
  boom.radius                = radius;
  boom.marker.translation[0] = {{1, 1.}};
  boom.marker.translation[2] = {{2, 1.}};
  boom.points                = {{0., 0., 0.}, {2. * arm, 0., 0.}};

  coupling::Body load;
  load.name       = "load";
  load.kind       = coupling::BodyKind::point;
  load.coordinate = 4;
  load.position   = {2. * arm, 0., -1.};
  for (int d = 0; d < 3; ++d)
    load.marker.translation[d] = {{4 + d, 1.}};
  scenery.bodies = {boom, load};

  const auto on_boom = [](const Vector3d &at) -> coupling::PlacedPoint
  {
    return {Placement(at, {arm, 0., 0.}, {{Vector3d::UnitX(), Vector3d::Zero()}, {Vector3d::UnitZ(), Vector3d::Zero()}},
                      -Vector3d::UnitY()),
            {{{1, 1.}}, {{2, 1.}}, {{3, 1.}}}};
  };
  const coupling::PlacedPoint on_frame = {
      Placement({0., 0., -1.}, {0., 0., -1.}, {{Vector3d::UnitZ(), Vector3d::Zero()}}), {{{0, 1.}}}};
  std::vector<Placement::LinearMeasure> free;
  for (int d = 0; d < 3; ++d)
    free.push_back({Vector3d::Unit(d), Vector3d::Zero()});
  const Vector3d              hook(2. * arm, 0., -1.);
  const coupling::PlacedPoint on_load = {Placement(hook, hook, free), {{{4, 1.}}, {{5, 1.}}, {{6, 1.}}}};

  scenery.bars = {{"rope", on_boom({2. * arm, 0., 0.}), on_load}, {"cylinder", on_frame, on_boom({arm, 0., 0.})}};
  scenery.pins = {{on_boom({0., 0., 0.}), {0., -1., 0.}}};
  return scenery;
}

/// The boom raised by the angle about the pivot, the load still hanging 1 m below its head, the frame lifted by 1 mm.
Eigen::VectorXd raised(double angle)
{
  const Vector3d head(2. * arm * std::cos(angle), 0., 2. * arm * std::sin(angle));
  return (Eigen::VectorXd(7) << 1e-3, 0.5 * head[0] - arm, 0.5 * head[2], angle, head[0] - 2. * arm, 0., head[2])
      .finished();
}

} // namespace

TEST(BodyShapes, AreClosedAndLookOutwards)
{
  for (const Shape &shape : mechanism_shapes(crane(), raised(2.)))
  {
    EXPECT_GT(volume(shape), 0.) << shape.name;
    EXPECT_LT(open_area(shape).norm(), 1e-12) << shape.name;
    EXPECT_EQ(shape.displacement.size(), shape.points.size()) << shape.name;
  }
}

TEST(BodyShapes, APlateIsTheHullOfItsPointsWithARim)
{
  const Shape boom = named(mechanism_shapes(crane(), raised(0.)), "boom");
  // 4 m between its ends, a full circle of 24 corners, one radius to either side.
  EXPECT_NEAR(volume(boom), (2. * arm * 2. * radius + 12. * std::sin(M_PI / 12.) * radius * radius) * 2. * radius,
              1e-9);
}

TEST(BodyShapes, APlanarBodyKeepsItsFormAtAnyAngle)
{
  const Shape before = named(mechanism_shapes(crane(), raised(0.)), "boom");
  for (const double angle : {0.3, M_PI / 2., 3., -40.})
  {
    const Shape after = named(mechanism_shapes(crane(), raised(angle)), "boom");
    for (std::size_t i = 1; i < before.points.size(); ++i)
      EXPECT_NEAR((after.points[i] - after.points[0]).norm(), (before.points[i] - before.points[0]).norm(), 1e-12);
    for (const Vector3d &d : after.displacement)
      EXPECT_EQ(d.norm(), 0.);
  }
}

TEST(BodyShapes, APlanarBodyStandsWhereItsCoordinatesPutIt)
{
  const auto          shapes = mechanism_shapes(crane(), raised(M_PI / 2.)); // about -y from x: upwards
  Eigen::AlignedBox3d box;
  for (const Vector3d &x : named(shapes, "boom").points)
    box.extend(x);
  EXPECT_LT((box.min() - Vector3d(-radius, -radius, -radius)).norm(), 1e-12);
  EXPECT_LT((box.max() - Vector3d(radius, radius, 2. * arm + radius)).norm(), 1e-12);
  EXPECT_LT((middle(named(shapes, "load")) - Vector3d(0., 0., 2. * arm - 1.)).norm(), 1e-12);
}

TEST(BodyShapes, ABodyWithASizeIsABoxAboutItsCentreOfMass)
{
  Scenery scenery        = crane();
  scenery.bodies[0].size = {3., 0.2, 0.4};
  const Shape boom       = named(mechanism_shapes(scenery, raised(M_PI / 2.)), "boom");
  EXPECT_NEAR(volume(boom), 3. * 0.2 * 0.4, 1e-12);
  EXPECT_LT((middle(boom) - Vector3d(0., 0., arm)).norm(), 1e-12);
  Eigen::AlignedBox3d box;
  for (const Vector3d &x : boom.points)
    box.extend(x);
  EXPECT_LT((box.sizes() - Vector3d(0.4, 0.2, 3.)).norm(), 1e-12);
}

// A box turned by a quarter about x and moved, with a bar to the joint that turns with it.
TEST(BodyShapes, ARigidBodyIsABoxWithBarsToItsJoints)
{
  coupling::Body body;
  body.name       = "link";
  body.kind       = coupling::BodyKind::rigid;
  body.coordinate = 0;
  body.position   = {1., 2., 3.};
  body.size       = {0.2, 0.4, 0.6};
  body.points     = {{1., 2., 4.}};
  for (int d = 0; d < 3; ++d)
    body.marker.translation[d] = {{d, 1.}};
  Scenery scenery;
  scenery.bodies                            = {body};
  Eigen::VectorXd q                         = Eigen::VectorXd::Zero(12);
  q.head<3>()                               = Vector3d(0.5, 0., 0.);
  const Eigen::Matrix3d turned              = Eigen::AngleAxisd(M_PI / 2., Vector3d::UnitX()).toRotationMatrix();
  Eigen::Map<Eigen::Matrix3d>(q.data() + 3) = turned - Eigen::Matrix3d::Identity();
  const Shape link = mechanism_shapes(scenery, q).front(), before = mechanism_shapes(scenery, 0. * q).front();
  ASSERT_EQ(link.points.size(), before.points.size());
  for (std::size_t i = 0; i < link.points.size(); ++i)
    EXPECT_LT((link.points[i] - Vector3d(1.5, 2., 3.) - turned * (before.points[i] - Vector3d(1., 2., 3.))).norm(),
              1e-12);
  Eigen::AlignedBox3d box;
  for (const Vector3d &x : link.points)
    box.extend(x);
  EXPECT_NEAR(box.min()[1], 1., 1e-12); // z of the joint has become -y
  EXPECT_NEAR(box.max()[1], 2.3, 1e-12);
  EXPECT_GT(volume(link), 0.2 * 0.4 * 0.6);
  EXPECT_LT(open_area(link).norm(), 1e-12);
}

TEST(BodyShapes, BarsReachFromPlaceToPlaceAndOnTheFrameMoveWithIt)
{
  for (const double angle : {0., 1., 2.5})
  {
    const auto  shapes = mechanism_shapes(crane(), raised(angle));
    const Shape rope = named(shapes, "rope"), cylinder = named(shapes, "cylinder");
    // The last two points of a bar are the middles of its ends.
    const auto end = [](const Shape &bar, int back) { return bar.points[bar.points.size() - back]; };
    EXPECT_NEAR((end(rope, 1) - end(rope, 2)).norm(), 1., 1e-12);
    EXPECT_LT((end(cylinder, 2) - Vector3d(0., 0., -1.)).norm(), 1e-12);
    EXPECT_LT((end(cylinder, 1) - arm * Vector3d(std::cos(angle), 0., std::sin(angle))).norm(), 1e-12);
    EXPECT_LT((cylinder.displacement[cylinder.points.size() - 2] - Vector3d(0., 0., 1e-3)).norm(), 1e-12);
    EXPECT_LT(cylinder.displacement.back().norm(), 1e-12);
    EXPECT_LT(middle(named(shapes, "joints")).norm(), 1e-12);
  }
}

TEST(BodyShapes, WhatHasNoSizeIsInProportionToTheMachine)
{
  Scenery scenery          = crane();
  scenery.bodies[0].radius = 0.;
  const auto   all         = mechanism_shapes(scenery, raised(0.));
  const double size        = scenery.size();
  EXPECT_NEAR(size, std::hypot(2. * arm, 1.), 1e-12);
  for (const Shape &shape : all)
  {
    Eigen::AlignedBox3d box;
    for (const Vector3d &x : shape.points)
      box.extend(x);
    EXPECT_GT(box.sizes().minCoeff(), 0.005 * size) << shape.name;
    EXPECT_LT(box.sizes().minCoeff(), 0.05 * size) << shape.name;
  }
  EXPECT_EQ(Scenery().size(), 1.);
}

TEST(BodyShapes, ARotorShowsItsAngleTowardsTheJointItCarries)
{
  Scenery scenery          = example_result().scenery;
  scenery.rods             = {};
  scenery.bodies[0].points = {{0.5 + 0.2, 0.5, 2.}}; // crank at (0.5, 0.5, 2) about y
  const Shape crank        = named(mechanism_shapes(scenery, Eigen::Vector4d(0., 0., M_PI / 2., 0.)), "crank");
  // The first corner of the disc lies along the pin: from x a quarter turn about y leads to -z.
  EXPECT_NEAR(crank.points[0][0], 0.5, 1e-12);
  EXPECT_NEAR(crank.points[0][2], 2. - 0.3, 1e-12);

  scenery.bodies[0].points = {{0.5 + 0.7, 0.5, 2.}}; // beyond the rim: the rib reaches out to it
  Eigen::AlignedBox3d box;
  for (const Vector3d &x : named(mechanism_shapes(scenery, Eigen::Vector4d::Zero()), "crank").points)
    box.extend(x);
  EXPECT_NEAR(box.max()[0], 1.2, 1e-12);
}

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
  EXPECT_NEAR(volume(named(shapes, "crank")), disc + rib, 1e-12);
  EXPECT_NEAR(volume(named(shapes, "slide")), 0.5 * 0.4 * 0.3, 1e-12);
  EXPECT_GT(volume(named(shapes, "rod")), 0.);
}

TEST(MechanismShapes, SlideStandsWhereTheCrankDrivesItAndCarriesTheRestAsDisplacement)
{
  const Scenery scenery = example_result().scenery;
  const double  r = 0.1, l = 0.8, phi = 2.1;
  const double  u      = -r * std::cos(phi) + std::sqrt(l * l - std::pow(r * std::sin(phi), 2)) - (l - r);
  const double  play   = 3e-4;
  const auto    shapes = mechanism_shapes(scenery, state(1e-4, 2e-4, phi, u + play));

  const Shape &slide = named(shapes, "slide");
  EXPECT_LT((centre(slide) - Vector3d(0.5, 0.5, 1.2 - u)).norm(), 1e-12);
  for (const Vector3d &d : slide.displacement)
    EXPECT_LT((d - Vector3d(0., 0., -play)).norm(), 1e-12);
  for (const Vector3d &d : named(shapes, "crank").displacement)
    EXPECT_LT((d - Vector3d(1e-4, 0., 2e-4)).norm(), 1e-12);
}

TEST(MechanismShapes, RodKeepsItsLengthAndItsPinIsOnTopAtDeadCentre)
{
  const Scenery scenery = example_result().scenery;
  for (const double phi : {0., 0.5, M_PI / 2., 2., M_PI, 5.})
  {
    const Shape rod    = named(mechanism_shapes(scenery, state(0., 0., phi, 0.)), "rod");
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

// How far a point lies outside of the faces of an interface.

#include "coupling/frame/face_reach.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

namespace gestell::coupling
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

fem::PlaneFace plate()
{
  fem::PlaneFace face;
  face.centre = {0.5, 0.4, 1.5};
  face.axes   = Matrix3d::Identity();
  face.half   = {0.5, 0.4};
  return face;
}

Matrix3d along(const Vector3d &way)
{
  return way * way.transpose();
}

TEST(FaceReach, IsTheDistanceFromThePlateAndTheSideAcrossIt)
{
  const FaceBox   box    = box_of(plate());
  const FaceReach nearby = reach_of(box, {1.3, 1.2, 1.5}), above = reach_of(box, {0.5, 0.4, 2.9});
  EXPECT_EQ(reach_of(box, {1., 0., 1.5}).outside, 0.);
  EXPECT_NEAR(nearby.outside / nearby.size, 0.5, 1e-14); // 0.3 and 0.4 of 1, or 0.4 of 0.8
  EXPECT_NEAR(above.outside, 1.4, 1e-14);
  EXPECT_NEAR(above.size, 0.8, 1e-14);                 // the shorter side, as a force along it has this lever, too
  EXPECT_FALSE(reach_of(box, {0.5, 0.4, 1.89}).far()); // a bracket of half that side
  EXPECT_TRUE(reach_of(box, {0.5, 0.4, 1.91}).far());
}

/// A bore of 250 mm diameter and up to as much length has its pin 100 mm beside it: along the axis or across.  Two of
/// them in line carry a shaft that is longer than their distance, but nothing beside their axis.
TEST(FaceReach, SeesAPinBesideItsBore)
{
  for (const double length : {0.03, 0.1, 0.25})
  {
    const FaceBox bore = box_between({-0.125, 0., -0.125}, {0.125, length, 0.125});
    EXPECT_TRUE(reach_of(bore, {0., length + 0.1, 0.}).far()) << length;
    EXPECT_TRUE(reach_of(bore, {0.225, 0.5 * length, 0.}).far()) << length;
    EXPECT_FALSE(reach_of(bore, {0.1, length + 0.02, 0.}).far()) << length;
  }
  const FaceBox bores = box_between({-0.125, -0.7, -0.125}, {0.125, 0.7, 0.125});
  EXPECT_FALSE(reach_of(bores, {0., 0.8, 0.}).far());
  EXPECT_TRUE(reach_of(bores, {0.225, 0., 0.}).far());
}

TEST(FaceReach, LeavesOutTheWayInFreeDirections)
{
  const FaceBox box = box_of(plate());
  EXPECT_NEAR(reach_of(box, {0.5, 0.4, 2.9}, along(Vector3d::UnitZ())).outside, 0., 1e-14);
  EXPECT_NEAR(reach_of(box, {-0.6, 0.4, 2.9}, along(Vector3d::UnitZ())).outside, 0.6, 1e-14);
  const Matrix3d plane = Matrix3d::Identity() - along(Vector3d::UnitZ());
  EXPECT_NEAR(reach_of(box, {7., 9., 1.8}, plane).outside, 0.3, 1e-14);
  // An oblique way that meets the plate.
  const Vector3d oblique = Vector3d(1., 0., 1.).normalized();
  EXPECT_NEAR(reach_of(box, {1.5, 0.4, 2.5}, along(oblique)).outside, 0., 1e-12);
}

TEST(FaceReach, TurnsWithTheFaces)
{
  const Matrix3d Q   = Eigen::AngleAxisd(0.7, Vector3d(1., 2., 3.).normalized()).toRotationMatrix();
  FaceBox        box = box_between({0., 0., 0.}, {0.2, 0.1, 0.4});
  const Vector3d x(0.5, -0.3, 0.6);
  const double   outside = reach_of(box, x).outside;
  EXPECT_NEAR(outside, std::hypot(0.3, 0.3), 1e-14); // of the side of 0.2 m
  box.centre = Q * box.centre;
  box.half   = Q * box.half;
  EXPECT_NEAR(reach_of(box, Q * x).outside, outside, 1e-14);
  EXPECT_NEAR(reach_of(box, Q * x).size, 0.2, 1e-14);
}

TEST(FaceReach, IsZeroWhereFacesAreNotKnown)
{
  EXPECT_EQ(reach_of(box_of({}), {9., 9., 9.}).outside, 0.);
}

} // namespace
} // namespace gestell::coupling

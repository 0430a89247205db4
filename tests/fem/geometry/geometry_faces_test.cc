// Faces known by points and normals, and the rules of selection; no gmsh.

#include "fem/geometry/face.h"
#include "fem/geometry/surface_selection.h"
#include "fem/values/vector3.h"
#include "tests/support/cad_samples.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

using namespace gestell::fem;
using namespace gestell::fem::test;

namespace
{

/// Part of a cylinder about the axis y = 1, z = 2: a bore if side = -1, a shaft if side = 1.
Face arc(int tag, double side, double x0, double x1, double angle = 6.28)
{
  Face face;
  face.tag = tag;
  for (int i = 0; i <= 6; ++i)
    for (const double x : {x0, x1})
    {
      const Vector3 radial{0., std::cos(angle * i / 6), std::sin(angle * i / 6)};
      face.samples.push_back({Vector3{x, 1., 2.} + 0.12 * radial, side * radial});
    }
  face.min    = {x0, 0.88, 1.88};
  face.max    = {x1, 1.12, 2.12};
  face.centre = {0.5 * (x0 + x1), 1., 2.};
  recognise(face, 1e-6);
  return face;
}

/// Square of side a in the plane z = 0.
Face square(int tag, double x, double up, double a = 0.1)
{
  Face face;
  face.tag    = tag;
  face.min    = {x, 0., 0.};
  face.max    = {x + a, a, 0.};
  face.centre = {x + a / 2, a / 2, 0.};
  for (const double dx : {0., a})
    for (const double dy : {0., a})
      face.samples.push_back({{x + dx, dy, 0.}, {0., 0., up}});
  recognise(face, 1e-6);
  return face;
}

TEST(Recognition, FindsAxisAndRadiusOfBoreAndShaft)
{
  for (const double side : {-1., 1.})
    for (const double angle : {0.3, 3., 6.28})
    {
      const Face face = arc(1, side, 0.2, 0.6, angle);
      ASSERT_EQ(face.kind, FaceKind::cylinder);
      EXPECT_NEAR(face.radius, 0.12, 1e-12);
      EXPECT_NEAR(norm(face.direction - Vector3{1., 0., 0.}), 0., 1e-12);
      EXPECT_NEAR(norm(face.through - Vector3{0.4, 1., 2.}), 0., 1e-12);
    }
}

TEST(Recognition, FindsThePlaneAndItsOutwardNormal)
{
  const Face face = square(1, 0., -1.);
  ASSERT_EQ(face.kind, FaceKind::plane);
  EXPECT_NEAR(norm(face.direction - Vector3{0., 0., -1.}), 0., 1e-12);
}

TEST(Recognition, OfASphereOrAConeClaimsNoCylinder)
{
  Face sphere, cone;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
    {
      const double  u = 0.2 + i, v = -1. + 0.4 * j;
      const Vector3 n{std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)};
      sphere.samples.push_back({0.3 * n, n});
      const Vector3 m{std::cos(0.1) * std::cos(u), std::cos(0.1) * std::sin(u), std::sin(0.1)}; // half angle 0.1
      const double  r = 0.3 - std::tan(0.1) * 0.1 * j;
      cone.samples.push_back({{r * std::cos(u), r * std::sin(u), 0.1 * j}, m});
    }
  recognise(sphere, 1e-6);
  recognise(cone, 1e-6);
  EXPECT_EQ(sphere.kind, FaceKind::other);
  EXPECT_EQ(cone.kind, FaceKind::other);
}

TEST(Selection, OfAPlaneRespectsTheOutwardNormal)
{
  const std::vector<Face> faces = {square(1, 0., 1.), square(2, 0.2, -1.)};
  EXPECT_EQ(select_faces(faces, plane({0., 0., 5.}, {9., 9., 0.}), 1.), std::vector<int>{1});
  EXPECT_EQ(select_faces(faces, plane({0., 0., -1.}, {9., 9., 0.}), 1.), std::vector<int>{2});
}

TEST(Selection, OfAnAxisTakesAllCoaxialFacesOrThatAroundThePoint)
{
  const std::vector<Face> faces = {arc(4, -1., 0., 0.1), arc(7, -1., 0.9, 1.)};
  const Vector3           x{-1., 0., 0.};
  EXPECT_EQ(select_faces(faces, cylinder(x, {5., 1., 2.}, 0.12, 2), 1.), (std::vector<int>{4, 7}));
  EXPECT_EQ(select_faces(faces, cylinder(x, {5., 1., 2.}, 0.12, 0), 1.), (std::vector<int>{4, 7}));
  EXPECT_EQ(select_faces(faces, cylinder(x, {0.95, 1., 2.}, 0.12, 1), 1.), std::vector<int>{7});
  EXPECT_THROW(select_faces(faces, cylinder(x, {0.5, 1., 2.}, 0.12, 1), 1.), std::invalid_argument);
}

/// A bore of two lengths that meet in a circle, and another one of the same axis apart from them.
TEST(Selection, DoesNotDependOnWhereThePointLiesAlongThePiecesItTakes)
{
  std::vector<Face> faces = {arc(4, -1., 0., 0.1), arc(5, -1., 0.1, 0.3)};
  faces[0].edges          = {1, 2};
  faces[1].edges          = {2, 3};
  const Vector3 x{1., 0., 0.};
  for (const double at : {-3., 0., 0.05, 0.1, 0.2, 0.3, 0.7})
    EXPECT_EQ(select_faces(faces, cylinder(x, {at, 1., 2.}, 0.12, 1), 1.), (std::vector<int>{4, 5})) << at;
  faces.push_back(arc(7, -1., 0.9, 1.));
  faces[2].edges = {4, 5};
  for (const double at : {0., 0.05, 0.1, 0.2, 0.3})
    EXPECT_EQ(select_faces(faces, cylinder(x, {at, 1., 2.}, 0.12, 1), 1.), (std::vector<int>{4, 5})) << at;
  for (const double at : {0.9, 0.95, 1.})
    EXPECT_EQ(select_faces(faces, cylinder(x, {at, 1., 2.}, 0.12, 1), 1.), std::vector<int>{7}) << at;
  for (const double at : {-3., 0.7, 2.})
    EXPECT_THROW(select_faces(faces, cylinder(x, {at, 1., 2.}, 0.12, 1), 1.), std::invalid_argument) << at;
}

/// Two bores of two halves each: the two faces of the one with the point, or two bores?
TEST(Selection, RefusesANumberOfTwoMeanings)
{
  std::vector<Face> faces = {arc(4, -1., 0., 0.1), arc(5, -1., 0., 0.1), arc(7, -1., 0.9, 1.), arc(8, -1., 0.9, 1.)};
  faces[0].edges = faces[1].edges = {1, 2};
  faces[2].edges = faces[3].edges = {3, 4};
  const auto taken                = [&](double at, int n) {
    return select_faces(faces, cylinder({1., 0., 0.}, {at, 1., 2.}, 0.12, n), 1.);
  };
  gestell::tests::expect_refusal(
      [&] { taken(0.05, 2); },
      "faces = 2 is ambiguous: it may be the 2 faces at 'through', which form 1 piece, or 2 pieces "
      "of 4 faces; write faces = 1 for the former, faces = 4 for the latter");
  EXPECT_EQ(taken(0.05, 1), (std::vector<int>{4, 5}));
  EXPECT_EQ(taken(0.05, 4), (std::vector<int>{4, 5, 7, 8}));
  EXPECT_EQ(taken(0.5, 2), (std::vector<int>{4, 5, 7, 8})); // no face there: the pieces are meant
}

TEST(Selection, NamesCoaxialFacesThatItDoesNotTake)
{
  const std::vector<Face> faces    = {arc(4, -1., 0., 0.1), arc(7, -1., 0.9, 1.), square(8, 0., 1.)};
  const SurfaceSelector   one      = cylinder({1., 0., 0.}, {0.95, 1., 2.}, 0.12, 1);
  const SurfaceSelector   all      = cylinder({1., 0., 0.}, {0.95, 1., 2.}, 0.12, 0);
  const auto              words_of = [&](const SurfaceSelector &selector, const std::vector<Face> &of)
  { return coaxial_faces(of, selector, select_faces(of, selector, 1.), 1.); };
  EXPECT_EQ(words_of(one, faces), "face 7; coaxial faces not selected: 4 (radius 0.12 m)");
  EXPECT_EQ(words_of(all, faces), "faces 4, 7");
  EXPECT_EQ(words_of(one, {faces[1], faces[2]}), "");
}

TEST(Selection, HoldsAllConditionsAtOnce)
{
  const std::vector<Face> faces    = {square(1, 0., 1.), square(2, 0.5, 1.)};
  SurfaceSelector         selector = plane({0., 0., 1.}, {0., 0., 0.});
  selector.box                     = SurfaceSelector::Box{{0.4, -1., -1.}, {0.7, 1., 1.}};
  EXPECT_EQ(select_faces(faces, selector, 1.), std::vector<int>{2});
  selector.group = "foot";
  EXPECT_THROW(select_faces(faces, selector, 1.), std::invalid_argument);
}

TEST(Selection, ToleranceIsTenThousandthOfTheModelUnlessGiven)
{
  const std::vector<Face> faces    = {square(1, 0., 1.)};
  SurfaceSelector         selector = plane({0., 0., 1.}, {0., 0., 0.5e-3});
  EXPECT_THROW(select_faces(faces, selector, 1.), std::invalid_argument);
  EXPECT_EQ(select_faces(faces, selector, 10.), std::vector<int>{1});
  selector.tolerance = 1e-3;
  EXPECT_EQ(select_faces(faces, selector, 1.), std::vector<int>{1});
}

TEST(Selection, ByNameTakesTheLastPartOfTheLabelToo)
{
  std::vector<Face> faces = {square(1, 0., 1.), square(2, 0.2, 1.)};
  faces[1].name           = "Shapes/press/foot";
  EXPECT_EQ(select_faces(faces, group("foot"), 1.), std::vector<int>{2});
  EXPECT_EQ(select_faces(faces, group("Shapes/press/foot"), 1.), std::vector<int>{2});
  faces[0].groups = {"foot"};
  EXPECT_EQ(select_faces(faces, group("foot", 0), 1.), (std::vector<int>{1, 2}));
}

TEST(Selection, RefusesBadParameters)
{
  const std::vector<Face> faces = {square(1, 0., 1.)};
  EXPECT_THROW(select_faces(faces, SurfaceSelector{}, 1.), std::invalid_argument);
  EXPECT_THROW(select_faces(faces, plane({0., 0., 0.}, {0., 0., 0.}), 1.), std::invalid_argument);
  EXPECT_THROW(select_faces(faces, cylinder({0., 0., 0.}, {0., 0., 0.}, 1.), 1.), std::invalid_argument);
  EXPECT_THROW(select_faces(faces, cylinder({0., 0., 1.}, {0., 0., 0.}, 0.), 1.), std::invalid_argument);
  EXPECT_THROW(select_faces(faces, plane({0., 0., 1.}, {0., 0., 0.}, -1), 1.), std::invalid_argument);
  SurfaceSelector selector = plane({0., 0., 1.}, {0., 0., 0.});
  selector.tolerance       = 0.;
  EXPECT_THROW(select_faces(faces, selector, 1.), std::invalid_argument);
}

} // namespace

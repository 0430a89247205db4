// Mass, centre and inertia of parts against closed forms; bad parts are refused.

#include "fem/mesh/measure_body.h"
#include "fem/values/triangle_surface.h"
#include "tests/support/cad_samples.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>
#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace occ = gmsh::model::occ;

namespace
{

constexpr double pi = 3.14159265358979323846;

CadBody measured(const std::string &path, double unit = 0.)
{
  return measure_part({path, unit, "scene.toml:7: body.rod"});
}

std::string complaint(const std::string &path, double unit = 0.)
{
  return gestell::tests::refusal([&] { measured(path, unit); });
}

/// A cuboid's tensor about its centre for density one.
Matrix3d cuboid(double a, double b, double c)
{
  return a * b * c / 12. * Vector3d(b * b + c * c, a * a + c * c, a * a + b * b).asDiagonal();
}

void expect_body(const CadBody &part, double volume, const Vector3d &centre, const Matrix3d &inertia, double tolerance)
{
  EXPECT_NEAR(part.volume, volume, tolerance * volume);
  EXPECT_LE((part.centre - centre).norm(), tolerance * std::cbrt(volume));
  EXPECT_LE((part.inertia - inertia).norm(), tolerance * inertia.norm()) << part.inertia << "\n\n" << inertia;
}

/// The skin encloses the part, from outside: exactly if its faces are plane.
double skin_volume(const CadBody &part)
{
  const TriangleSurface skin{part.points, part.triangles};
  EXPECT_EQ(unmatched_edges(skin), 0);
  return enclosed_volume(skin);
}

/// OpenCASCADE's Gauss points are exact on polynomials; the STEP file has 15 digits.
constexpr double rounding = 1e-10;

TEST(CadBody, CuboidOffTheOriginHasItsClosedForm)
{
  const CadBody part = measured(draw("cuboid.step", [] { occ::addBox(1000., 200., -300., 400., 100., 50.); }));
  expect_body(part, 0.4 * 0.1 * 0.05, {1.2, 0.25, -0.275}, cuboid(0.4, 0.1, 0.05), rounding);
  EXPECT_NEAR(skin_volume(part), part.volume, 1e-9 * part.volume);
  EXPECT_EQ(part.solids.size(), 1u);
}

TEST(CadBody, TurnedCuboidHasTheTurnedTensor)
{
  const Vector3d axis  = Vector3d(1., 2., 3.).normalized();
  const double   angle = 0.7;
  const CadBody  part  = measured(draw("turned.step",
                                       [&]
                                       {
                                       const int box = occ::addBox(0., 0., 0., 400., 100., 50.);
                                       occ::rotate({{3, box}}, 0., 0., 0., axis.x(), axis.y(), axis.z(), angle);
                                     }));
  const Matrix3d R     = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  expect_body(part, 0.4 * 0.1 * 0.05, R * Vector3d(0.2, 0.05, 0.025), R * cuboid(0.4, 0.1, 0.05) * R.transpose(),
              rounding);
}

TEST(CadBody, HollowCylinderHasItsClosedFormAndASkinThatIsClosed)
{
  const double  R = 0.12, r = 0.05, l = 0.3, V = pi * (R * R - r * r) * l;
  const CadBody part = measured(draw("hollow.step",
                                     []
                                     {
                                       const int        outer = occ::addCylinder(50., 0., 0., 0., 300., 0., 120.);
                                       const int        inner = occ::addCylinder(50., 0., 0., 0., 300., 0., 50.);
                                       gmsh::vectorpair out;
                                       std::vector<gmsh::vectorpair> map;
                                       occ::cut({{3, outer}}, {{3, inner}}, out, map);
                                     }));
  const double  Jy = 0.5 * V * (R * R + r * r), Jx = V * ((R * R + r * r) / 4. + l * l / 12.);
  expect_body(part, V, {0.05, 0.15, 0.}, Vector3d(Jx, Jy, Jx).asDiagonal(), rounding);
  // Of a circle in n = 16 edges the share sin(2 pi/n)/(2 pi/n) = 0.975 remains, of the difference of two likewise.
  EXPECT_NEAR(skin_volume(part), V, 0.03 * V);
}

TEST(CadBody, CavityIsNotFilled)
{
  const double  R = 0.1, r = 0.06, V = 4. / 3. * pi * (R * R * R - r * r * r);
  const CadBody part = measured(draw("shell.step",
                                     []
                                     {
                                       const int                     outer = occ::addSphere(0., 0., 0., 100.);
                                       const int                     inner = occ::addSphere(0., 0., 0., 60.);
                                       gmsh::vectorpair              out;
                                       std::vector<gmsh::vectorpair> map;
                                       occ::cut({{3, outer}}, {{3, inner}}, out, map);
                                     }));
  const double  J    = 8. / 15. * pi * (std::pow(R, 5) - std::pow(r, 5));
  expect_body(part, V, {0., 0., 0.}, J * Matrix3d::Identity(), rounding);
  EXPECT_NEAR(skin_volume(part), V, 0.1 * V); // the inner sphere counts against the outer one
}

TEST(CadBody, SeveralSolidsAreSummedByTheParallelAxisTheorem)
{
  const CadBody part = measured(draw("dumbbell.step",
                                     []
                                     {
                                       occ::addBox(-250., -50., -50., 100., 100., 100.);
                                       occ::addBox(150., -50., -50., 100., 100., 100.);
                                     }));
  Matrix3d      J    = 2. * cuboid(0.1, 0.1, 0.1);
  J(1, 1) += 2. * 1e-3 * 0.04;
  J(2, 2) += 2. * 1e-3 * 0.04;
  expect_body(part, 2e-3, Vector3d::Zero(), J, rounding);
  EXPECT_EQ(part.solids.size(), 2u);
}

TEST(CadBody, UnitIsThatOfTheFileOrTheOneGiven)
{
  const std::string step = draw("two.step", [] { occ::addBox(0., 0., 0., 2., 1., 1.); });
  EXPECT_NEAR(measured(step).volume, 2e-9, 1e-18);
  EXPECT_NEAR(measured(step, 1.).volume, 2., 1e-9);
}

/// Two tetrahedra that make a pyramid; and its surface.
std::string pyramid_mesh()
{
  return write_text("pyramid.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 2 0 0\n3 2 2 0\n"
                                   "4 0 2 0\n5 1 1 3\n$EndNodes\n$Elements\n2\n1 4 2 1 1 1 2 3 5\n2 4 2 1 1 1 3 4 5\n"
                                   "$EndElements\n");
}

std::string pyramid_stl(const std::string &name, std::size_t n_faces)
{
  const double x[5][3]    = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};
  const int    faces[][3] = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  std::string  text       = "solid pyramid\n";
  for (std::size_t f = 0; f < n_faces; ++f)
  {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int i : faces[f])
      text +=
          "vertex " + std::to_string(x[i][0]) + " " + std::to_string(x[i][1]) + " " + std::to_string(x[i][2]) + "\n";
    text += "endloop\nendfacet\n";
  }
  return write_text(name, text + "endsolid pyramid\n");
}

TEST(CadBody, PyramidOfTetrahedraOrTrianglesHasItsClosedForm)
{
  // Square side a = 2, height h = 3: V = a^2 h/3, centre at h/4, J_z = V a^2/10, J_x = V (a^2/20 + 3 h^2/80).
  const double   V = 4., unit = 0.1, u5 = std::pow(unit, 5);
  const Matrix3d J = u5 * V * Vector3d(0.2 + 27. / 80., 0.2 + 27. / 80., 0.4).asDiagonal();
  for (const CadBody &part : {measured(pyramid_mesh(), unit), measured(pyramid_stl("pyramid.stl", 6), unit)})
  {
    expect_body(part, 4e-3, {0.1, 0.1, 0.075}, J, 1e-12);
    EXPECT_NEAR(skin_volume(part), 4e-3, 1e-15);
  }
}

TEST(CadBody, ThatIsNotAClosedBodyIsRefused)
{
  EXPECT_THAT(complaint("/no/such/rod.step"), AllOf(StartsWith("scene.toml:7: body.rod"), HasSubstr("does not exist")));
  const std::string sheet = draw("sheet.step", [] { occ::addRectangle(0., 0., 0., 100., 100.); });
  EXPECT_THAT(complaint(sheet), HasSubstr("no closed solid, only 1 faces"));
  EXPECT_THAT(complaint(pyramid_stl("open.stl", 5), 0.1),
              AllOf(HasSubstr("not a closed surface"), HasSubstr("3 of its")));
  EXPECT_THAT(complaint(pyramid_stl("plain.stl", 6)), HasSubstr("unit = \"1 mm\""));
}

TEST(CadBody, WithAFaceTurnedInsideOutIsRefused)
{
  for (const std::string file : {"negative_area.brep", "part_of_negative_inertia.brep"})
    EXPECT_THAT(complaint(GESTELL_SOURCE_DIR "/tests/fuzz/mesh/found/" + file, 1.), HasSubstr("turned inside out"));
}

TEST(CadBody, ThatLiesFarFromTheOriginIsRefused)
{
  const auto box = [](double x) { return draw("far.step", [x] { occ::addBox(x, 0., 0., 1e3, 1e3, 1e3); }); };
  EXPECT_THAT(complaint(box(1e8)), HasSubstr("where its moments of inertia lose their digits"));
  const CadBody near = measured(box(1e7)); // 10 km
  EXPECT_NEAR(near.inertia(0, 0), 1. / 6., 1e-6);
}

TEST(CadBody, WhoseSolidsOverlapIsRefused)
{
  const auto two = [](double x)
  {
    return [x]
    {
      occ::addBox(0., 0., 0., 100., 100., 100.);
      occ::addBox(x, 0., 0., 100., 100., 100.);
    };
  };
  EXPECT_THAT(complaint(draw("overlapping.step", two(75.))), AllOf(HasSubstr("overlap"), HasSubstr("0.00175 m^3")));
  EXPECT_EQ(complaint(draw("touching.step", two(100.))), "");
}

TEST(Frame, OfTrianglesIsRefused)
{
  EXPECT_THAT(refusal(specification(pyramid_stl("frame.stl", 6), 0.1)), HasSubstr("export it as STEP"));
}

} // namespace

// Models of several solids: joined where they touch, refused where they overlap or lie apart, with what helps.

#include "fem/mesh/mesh_quality.h"
#include "fem/mesh/mesher.h"
#include "fem/values/vector3.h"
#include "tests/support/cad_samples.h"
#include "tests/support/mesh_measures.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <gmsh.h>

using namespace gestell::fem;
using namespace gestell::fem::test;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace
{

/// Two cubes of 100 mm, the second displaced by (x, y, z) mm.
std::string two_cubes(double x, double y = 0., double z = 0.)
{
  return draw("two.step",
              [=]
              {
                gmsh::model::occ::addBox(0., 0., 0., 100., 100., 100.);
                gmsh::model::occ::addBox(x, y, z, 100., 100., 100.);
              });
}

double area_of_skin(const Mesh &mesh)
{
  double sum = 0.;
  for (const auto &[a, b, c] : mesh.skin)
    sum += 0.5 * norm(cross(mesh.points[b] - mesh.points[a], mesh.points[c] - mesh.points[a]));
  return sum;
}

TEST(SolidsThatTouch, ShareTheNodesOfTheirCommonFace)
{
  const Mesh mesh = make_mesh(specification(two_cubes(100., 20., 0.), 0.05));
  EXPECT_EQ(mesh.solids.size(), 2u);
  EXPECT_NEAR(volume_of_cells(mesh), 2e-3, 1e-12);
  EXPECT_NEAR(area_of_skin(mesh), 12 * 0.01 - 2 * 0.1 * 0.08, 1e-10); // what they share is inside
  ASSERT_FALSE(mesh.statements.empty());
  EXPECT_THAT(mesh.statements[0], HasSubstr("2 solids are joined at 1 common face"));
}

TEST(SolidsThatTouch, InALineOnlyAreTwoBodies)
{
  EXPECT_THAT(refusal(specification(two_cubes(100., 100., 0.), 0.05)),
              AllOf(HasSubstr("2 bodies without common faces"), HasSubstr("meet in a line or a point")));
}

TEST(SolidsThatOverlap, AreRefusedWithTheVolumeThatWouldCountTwice)
{
  const std::string cad = two_cubes(50.);
  EXPECT_THAT(refusal(specification(cad, 0.05)), AllOf(StartsWith("scene.toml:3: frame"), HasSubstr("share 0.0005 m^3"),
                                                       HasSubstr("overlaps = \"once\"")));
  FrameSpecification s = specification(cad, 0.05);
  s.mesh.overlaps      = Overlaps::once;
  EXPECT_NEAR(volume_of_cells(make_mesh(s)), 1.5e-3, 1e-12);
}

/// As two_cubes(), drawn by a script that joins nothing and names the face it stands on and one that is shared.
std::string two_cubes_of_a_script(double x, double y)
{
  return write_text("two.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 100, 100, 100};\nBox(2) = {" +
                                   std::to_string(x) + ", " + std::to_string(y) +
                                   ", 0, 100, 100, 100};\n"
                                   "Physical Volume(\"left\") = {1};\nPhysical Volume(\"right\") = {2};\n"
                                   "Physical Surface(\"feet\") = {5, 11};\nPhysical Surface(\"side\") = {2};\n");
}

FrameSpecification in_millimetres(const std::string &cad)
{
  FrameSpecification s = specification(cad, 0.05);
  s.unit               = 1e-3;
  return s;
}

TEST(SolidsOfAScript, ThatTouchAreJoinedAndKeepTheirGroups)
{
  FrameSpecification s = in_millimetres(two_cubes_of_a_script(100., 20.));
  s.surfaces           = {{"feet", group("feet", 2)}, {"side", group("side", 1)}};
  const Mesh mesh      = make_mesh(s);
  EXPECT_EQ(mesh.solids, (std::vector<std::string>{"left", "right"}));
  EXPECT_NEAR(volume_of_cells(mesh), 2e-3, 1e-12);
  EXPECT_NEAR(norm(area_vector(mesh, "feet") - Vector3{0., 0., -0.02}), 0., 1e-12);
  EXPECT_NEAR(norm(area_vector(mesh, "side") - Vector3{0.1 * 0.02, 0., 0.}), 0., 1e-12); // what is left of it outside
}

TEST(SolidsOfAScript, ThatOverlapAreJudgedLikeThoseOfAStepFile)
{
  FrameSpecification s = in_millimetres(two_cubes_of_a_script(50., 0.));
  EXPECT_THAT(refusal(s),
              AllOf(HasSubstr("\"left\" and \"right\" share 0.0005 m^3"), HasSubstr("overlaps = \"once\"")));
  s.mesh.bodies = 2;
  EXPECT_THAT(refusal(s), HasSubstr("share 0.0005 m^3"));
  s.mesh.bodies   = 1;
  s.mesh.overlaps = Overlaps::once;
  EXPECT_NEAR(volume_of_cells(make_mesh(s)), 1.5e-3, 1e-12);
}

TEST(SolidsOfAScript, WithAGapAreJoinedWhereItIsAllowed)
{
  FrameSpecification s = in_millimetres(two_cubes_of_a_script(100.05, 0.));
  EXPECT_THAT(refusal(s), HasSubstr("mesh.gap = \"0.0505 mm\""));
  s.mesh.gap = 0.1e-3;
  EXPECT_NEAR(volume_of_cells(make_mesh(s)), 2e-3, 2e-6); // 0.05 mm of 200 mm
}

TEST(SolidsWithAGap, AreRefusedWithItsWidthItsPlaceAndItsFaces)
{
  EXPECT_THAT(refusal(specification(two_cubes(100.05), 0.05)),
              AllOf(StartsWith("scene.toml:3: frame"), HasSubstr("2 bodies without common faces"),
                    HasSubstr("are 0.05 mm apart at (0.10002 0"), HasSubstr("plane, normal (1 0 0)"),
                    HasSubstr("plane, normal (-1 0 0)"), HasSubstr("mesh.gap = \"0.0505 mm\"")));
}

TEST(SolidsWithAGap, AreJoinedWhereTheGapIsAllowed)
{
  FrameSpecification s = specification(two_cubes(100.05), 0.05);
  s.mesh.gap           = 0.1e-3;
  const Mesh mesh      = make_mesh(s);
  EXPECT_NEAR(volume_of_cells(mesh), 2e-3, 2e-6); // 0.05 mm of 200 mm
  EXPECT_NEAR(area_of_skin(mesh), 10 * 0.01, 1e-4);
}

TEST(SolidsWithAGap, ThatIsNotASmallShareOfTheirThicknessAreRefused)
{
  // A cube of 100 mm has 2 V / A = 33.3 mm.
  FrameSpecification s = specification(two_cubes(100.05), 0.05);
  for (const double wide : {0.0112, 0.05, 0.2})
  {
    s.mesh.gap = wide;
    EXPECT_THAT(refusal(s),
                AllOf(StartsWith("scene.toml:4: frame.mesh: gap = " + text(wide) + " m"),
                      HasSubstr("is only 0.033333 m thick on average"), HasSubstr("set gap below 0.011111 m")));
  }
  s.mesh.gap = 0.011;
  EXPECT_NEAR(volume_of_cells(make_mesh(s)), 2e-3, 2e-6);

  EXPECT_THAT(refusal(specification(two_cubes(130.), 0.05)),
              AllOf(HasSubstr("are 30 mm apart"), HasSubstr("too far apart for mesh.gap"), HasSubstr("11.111 mm"),
                    HasSubstr("mesh.bodies = 2")));
}

TEST(SolidsOfAScript, ThatMaterialsNameWronglyAreReportedBeforeTheMesh)
{
  FrameSpecification s = in_millimetres(two_cubes_of_a_script(100., 20.));
  s.materials          = {{"rigth", {70e9, 0.3, 2700., "scene.toml:9"}}};
  for (const bool meshed : {false, true})
    EXPECT_THAT(gestell::tests::refusal([&] { meshed ? void(make_mesh(s)) : void(inspect_geometry(s)); }),
                AllOf(StartsWith("scene.toml:9: there is no solid \"rigth\""), HasSubstr("\"right\", \"left\"")));
}

TEST(SolidsWithAGap, AreTwoBodiesWhereTwoAreExpected)
{
  FrameSpecification s = specification(two_cubes(100.05), 0.05);
  s.mesh.bodies        = 2;
  EXPECT_NEAR(volume_of_cells(make_mesh(s)), 2e-3, 1e-12);
  s.mesh.bodies = 3;
  EXPECT_THAT(refusal(s), AllOf(StartsWith("scene.toml:4: frame.mesh"), HasSubstr("bodies = 3"), HasSubstr("holds 2")));
}

TEST(SolidsWithAGap, OfAPinInABoreAreMeasuredAlongTheRadius)
{
  const std::string cad = draw("pin.step",
                               []
                               {
                                 namespace occ = gmsh::model::occ;
                                 gmsh::vectorpair              bored;
                                 std::vector<gmsh::vectorpair> map;
                                 occ::addBox(0., 0., 0., 100., 100., 30., 1);
                                 occ::addCylinder(50., 50., 0., 0., 0., 30., 20.08, 2);
                                 occ::cut({{3, 1}}, {{3, 2}}, bored, map);
                                 occ::addCylinder(50., 50., -10., 0., 0., 50., 20., 3);
                               });
  EXPECT_THAT(refusal(specification(cad, 0.02)),
              AllOf(HasSubstr("are 0.08 mm apart"), HasSubstr("radius 0.02008"), HasSubstr("radius 0.02,")));
}

TEST(SelectorsOfABore, CountItsHalvesAsOneFace)
{
  const std::string cad = draw("halves.step",
                               []
                               {
                                 namespace occ = gmsh::model::occ;
                                 gmsh::vectorpair              bored;
                                 std::vector<gmsh::vectorpair> map;
                                 const double                  pi = std::acos(-1.);
                                 occ::addBox(-50., -50., 0., 100., 100., 40., 1);
                                 occ::addCylinder(0., 0., 0., 0., 0., 40., 20., 2, pi);
                                 occ::addCylinder(0., 0., 0., 0., 0., 40., 20., 3, pi);
                                 occ::rotate({{3, 3}}, 0., 0., 0., 0., 0., 1., pi);
                                 occ::cut({{3, 1}}, {{3, 2}, {3, 3}}, bored, map);
                                 occ::rotate(bored, 0., 0., 0., 1., 2., 3., 0.7); // any direction in space
                               });
  const Vector3     axis{1. / std::sqrt(14.), 2. / std::sqrt(14.), 3. / std::sqrt(14.)}, z{0., 0., 1.};
  const Vector3     turned =
      std::cos(0.7) * z + std::sin(0.7) * cross(axis, z) + (1. - std::cos(0.7)) * dot(axis, z) * axis; // Rodrigues
  FrameSpecification s        = specification(cad, 0.01);
  s.surfaces["bore"]          = cylinder(turned, {0., 0., 0.}, 0.02);
  const GeometryReport report = report_geometry(s);
  EXPECT_EQ(report.surfaces.at("bore").size(), 2u);
  s.surfaces["bore"].faces = 3;
  EXPECT_THAT(refusal(s), HasSubstr("2 faces match"));
}

TEST(SelectorsByBox, SayWhichFacesTheBoxCutsThrough)
{
  FrameSpecification s  = specification(two_cubes(100.), 0.05);
  s.surfaces["top"]     = plane({0., 0., 1.}, {0., 0., 0.1});
  s.surfaces["top"].box = SurfaceSelector::Box{{-0.01, -0.01, 0.}, {0.05, 0.11, 0.11}};
  EXPECT_THAT(refusal(s), AllOf(HasSubstr("no face matches"), HasSubstr("The box cuts through face"),
                                HasSubstr("selectors take whole faces")));
}

} // namespace

// Bodies whose mass and inertia come from the drawing of the part, against closed forms.

#include "tests/support/program.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

namespace gestell::test
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double pi = 3.14159265358979323846;

const std::string factory = "SetFactory(\"OpenCASCADE\");\n";
const std::string cuboid  = factory + "Box(1) = {0.1, 0, 0, 0.6, 0.04, 0.1};\n";        // in metres, 2.4e-3 m^3
const std::string disc    = factory + "Cylinder(1) = {0, -0.05, 0, 0, 0.1, 0, 0.2};\n"; // about y

/// Scenes beside a file "part.geo" with this drawing.
class Drawing
{
public:
  explicit Drawing(const std::string &part, const std::string &file = "part.geo")
  {
    setenv("GESTELL_PLUGIN_DIR", GESTELL_BINARY_DIR "/bin", 1);
    folder_.write(file, part);
  }

  apps::Scene scene(const std::string &body) const
  {
    return apps::read_scene(folder_.write("scene.toml", "[body.b]\n" + body));
  }
  apps::BodyRequest body(const std::string &text) const { return scene("cad = \"part.geo\"\n" + text).bodies.at(0); }
  std::string       complaint(const std::string &text) const
  {
    return tests::refusal([&] { scene(text); });
  }

private:
  SceneFolder folder_;
};

Vector3d vector(const apps::Vector3 &x)
{
  return Vector3d(x.data());
}

constexpr double m = 7850. * 2.4e-3; // of the cuboid in steel
const Matrix3d   J = m / 12. * Vector3d(0.04 * 0.04 + 0.01, 0.36 + 0.01, 0.36 + 0.04 * 0.04).asDiagonal();

TEST(BodyFromCad, RigidOneHasTheTensorOfTheCuboid)
{
  const auto body = Drawing(cuboid).body("type = \"rigid\"\nmaterial = \"steel\"\n");
  EXPECT_NEAR(body.mass, m, 1e-9 * m);
  EXPECT_LE((vector(body.position) - Vector3d(0.4, 0.02, 0.05)).norm(), 1e-12);
  EXPECT_LE((body.tensor - J).norm(), 1e-9 * J.norm());
}

TEST(BodyFromCad, PlacementTurnsAndMovesIt)
{
  const auto body  = Drawing(cuboid).body("type = \"rigid\"\ndensity = 7850\nplacement = { origin = [1, 2, 3], axis = "
                                           "[0, 2, 0], angle = \"30 deg\" }\n");
  const Matrix3d R = Eigen::AngleAxisd(pi / 6., Vector3d::UnitY()).toRotationMatrix();
  EXPECT_LE((vector(body.position) - (Vector3d(1., 2., 3.) + R * Vector3d(0.4, 0.02, 0.05))).norm(), 1e-12);
  EXPECT_LE((body.tensor - R * J * R.transpose()).norm(), 1e-9 * J.norm());
  Eigen::AlignedBox3d box;
  for (const auto &x : body.part->shape.points)
    box.extend(R.transpose() * (vector(x) - Vector3d(1., 2., 3.)));
  EXPECT_LE((box.min() - Vector3d(0.1, 0., 0.)).norm() + (box.max() - Vector3d(0.7, 0.04, 0.1)).norm(), 1e-9)
      << "its picture goes with it";
}

TEST(BodyFromCad, PlanarOneHasTheInertiaAboutItsNormal)
{
  const auto body = Drawing(cuboid).body("type = \"planar\"\nnormal = [0, 1, 0]\nmass = \"10 kg\"\n");
  EXPECT_NEAR(body.mass, 10., 1e-9);
  EXPECT_NEAR(body.inertia, 10. / m * J(1, 1), 1e-9) << "a weighed mass is spread evenly";
}

TEST(BodyFromCad, RotorTakesTheInertiaAboutItsAxisAndWarnsOfUnbalance)
{
  const double      M     = 2700. * pi * 0.04 * 0.1;
  const std::string rotor = "type = \"rotor\"\naxis = [0, 1, 0]\nmaterial = \"aluminium\"\n";
  const auto        scene = Drawing(disc).scene("cad = \"part.geo\"\n" + rotor);
  EXPECT_NEAR(scene.bodies.at(0).inertia, 0.5 * M * 0.04, 1e-9 * M);
  EXPECT_NEAR(scene.bodies.at(0).mass, M, 1e-9 * M);
  EXPECT_TRUE(scene.warnings.empty());

  const auto nearby = Drawing(disc).scene("cad = \"part.geo\"\n" + rotor + "position = [\"30 mm\", \"7 m\", 0]\n");
  EXPECT_NEAR(nearby.bodies.at(0).inertia, 0.5 * M * 0.04 + M * 0.0009, 1e-9 * M) << "Steiner's theorem";
  ASSERT_EQ(nearby.warnings.size(), 1u);
  EXPECT_THAT(nearby.warnings[0], HasSubstr("body.b.cad: the centre of mass is 30 mm off the axis"));
}

TEST(BodyFromCad, SliderAndPointTakeTheMassOfAllSolids)
{
  const Drawing two(cuboid + "Box(2) = {2, 0, 0, 0.6, 0.04, 0.1};\n");
  const auto    slider = two.body("type = \"slider\"\naxis = [1, 0, 0]\nmaterial = \"steel\"\n");
  EXPECT_NEAR(slider.mass, 2. * m, 1e-9 * m);
  EXPECT_THAT(slider.part->found, HasSubstr("the sum of 2 solids"));
  EXPECT_NEAR(two.body("type = \"point\"\nmaterial = { E = 1e9, nu = 0.3, rho = 1000 }\n").mass, 4.8, 1e-8);
}

TEST(BodyFromCad, ADensityNoSolidHasIsRefusedAsAPlainNumberAndElseGivesAWarning)
{
  const Drawing     drawing(cuboid);
  const std::string point = "cad = \"part.geo\"\ntype = \"point\"\n";
  EXPECT_THAT(drawing.complaint(point + "density = 7.85e-9\n"),
              AllOf(HasSubstr("body.b.density"), HasSubstr("if 7.85e-09 t/mm^3 was meant")));
  EXPECT_THAT(drawing.scene(point + "density = \"40 kg/m^3\"\n").warnings,
              ElementsAre(HasSubstr("body.b.density: is 40 kg/m^3, lighter than any solid")));
  EXPECT_THAT(drawing.scene(point + "mass = 0.0188\n").warnings, // in tonnes
              ElementsAre(AllOf(HasSubstr("body.b.mass: spread evenly over the 0.0024 m^3 of its shape"),
                                HasSubstr("is 7.83333 kg/m^3, lighter than any solid"))));
  EXPECT_TRUE(drawing.scene(point + "density = 7850\n").warnings.empty());
}

TEST(BodyFromCad, WhatIsMissingContradictsOrIsNotASolidIsRefused)
{
  const Drawing     drawing(cuboid);
  const std::string cad   = "cad = \"part.geo\"\ntype = \"planar\"\nnormal = [0, 1, 0]\n",
                    steel = "material = \"steel\"\n";
  const auto says         = [&](const std::string &more) { return drawing.complaint(cad + more); };
  EXPECT_THAT(says(""), AllOf(HasSubstr("body.b"), HasSubstr("no density")));
  EXPECT_THAT(says(steel + "mass = 3\n"), HasSubstr("keep one of them"));
  EXPECT_THAT(says(steel + "inertia = 3\n"), HasSubstr("follows from the shape"));
  EXPECT_THAT(says(steel + "position = [0, 0, 0]\n"), HasSubstr("placement"));
  EXPECT_THAT(says(steel + "radius = 0.1\n"), HasSubstr("remove it"));
  EXPECT_THAT(says(steel + "placement = { axis = [0, 0, 1] }\n"), HasSubstr("has an axis and no angle"));
  EXPECT_THAT(says("material = \"steal\"\n"), HasSubstr("steel"));
  EXPECT_THAT(drawing.complaint("cad = \"prat.geo\"\ntype = \"point\"\n" + steel), HasSubstr("prat.geo"));
  const Drawing sheet(factory + "Rectangle(1) = {0, 0, 0, 1, 1};\n");
  EXPECT_THAT(sheet.complaint(cad + steel), AllOf(HasSubstr("body.b"), HasSubstr("no closed solid")));
}

/// A cuboid on a pin at the origin swings with omega^2 = m g s/(J + m s^2), s from the pin to the centre of mass.
TEST(BodyFromCad, SwingsAsAPhysicalPendulum)
{
  const tests::Folder folder("pendulum");
  folder.file("part.geo", factory + "Box(1) = {-0.05, -0.02, -0.7, 0.1, 0.04, 0.6};\n");
  const std::string scene  = folder.file("scene.toml", R"(gravity = [0, 0, -9.81]
[body.arm]
type     = "planar"
normal   = [0, 1, 0]
cad      = "part.geo"
material = "steel"
[joint.pin]
type = "revolute"
from = "ground"
to   = "arm"
at   = [0, 0, 0]
)");
  const auto        answer = tests::gestell("modes " + scene + folder.option());
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  const double s = 0.4, omega = std::sqrt(9.81 * s / (J(1, 1) / m + s * s));
  const auto   summary = tests::read(folder.results() / "summary.json");
  EXPECT_NEAR(tests::json_number(summary, {"frequencies_hz"}), omega / (2. * pi), 1e-8) << summary;
  EXPECT_THAT(summary, HasSubstr("arm from part.geo: 18.84 kg"));

  const auto check = tests::gestell("check " + scene);
  EXPECT_TRUE(check.says("arm from part.geo: 18.84 kg (7850 kg/m^3), centre of mass [0, 0, -0.4] m")) << check.text;
}

TEST(MeshCommand, WeighsInTheDensityAskedFor)
{
  setenv("GESTELL_PLUGIN_DIR", GESTELL_BINARY_DIR "/bin", 1);
  const tests::Folder folder("weighs");
  const std::string   part = folder.file("part.geo", cuboid);
  const auto steel = tests::gestell("mesh " + part), light = tests::gestell("mesh " + part + " --density '2.7 t/m^3'");
  EXPECT_TRUE(steel.says("volume 0.0024 m^3, 18.84 kg in steel")) << steel.text;
  EXPECT_TRUE(light.says("volume 0.0024 m^3, 6.48 kg at 2700 kg/m^3")) << light.text;
  EXPECT_FALSE(light.says("warning")) << light.text;
  const auto odd = tests::gestell("mesh " + part + " --density 7.85e-9");
  expect_answer(odd, 0,
                {"warning: --density is 7.85e-09 kg/m^3, lighter than any solid; if 7.85e-09 t/mm^3 was meant"});
  const auto wrong = tests::gestell("mesh " + part + " --density '3 m'");
  expect_answer(wrong, 2, {"--density: "});
}

} // namespace
} // namespace gestell::test

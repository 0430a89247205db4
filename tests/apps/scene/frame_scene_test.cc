#include "apps/scene/build/build_machine.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

TEST(SceneFrame, MassesMaterialsAndPointsBecomeTheSpecification)
{
  const auto text =
      cad_scene("[frame.cut", "[frame.materials]\n\"crown *\" = \"cast iron\"\n"
                              "[frame.mass.motor]\nmass = \"80 kg\"\non = \"frame.crown\"\n"
                              "inertia = [1, 2, 2.5]\nposition = [0, 0, \"2 m\"]\n"
                              "[frame.mass.weight]\nmass = 30\nsurface = \"feet\"\ncoupling = \"average\"\n"
                              "[frame.interface.lug]\nsurface = \"feet\"\ncoupling = \"point\"\n"
                              "position = [1, 0, 0]\nradius = \"50 mm\"\n[frame.cut");
  const auto frame = scene_of(text).frame.geometry;
  ASSERT_EQ(frame.materials.size(), 1u);
  EXPECT_EQ(frame.materials[0].first, "crown *");
  EXPECT_DOUBLE_EQ(frame.materials[0].second.rho, 7200.);
  ASSERT_EQ(frame.masses.size(), 2u);
  EXPECT_EQ(frame.masses[0].interface, "crown");
  EXPECT_DOUBLE_EQ(frame.masses[0].inertia(1, 1), 2.);
  EXPECT_DOUBLE_EQ((*frame.masses[0].centre)[2], 2.);
  EXPECT_EQ(frame.masses[1].coupling, fem::InterfaceCoupling::average);
  EXPECT_FALSE(frame.masses[1].centre);
  const auto lug =
      std::find_if(frame.interfaces.begin(), frame.interfaces.end(), [](const auto &i) { return i.name == "lug"; });
  ASSERT_NE(lug, frame.interfaces.end());
  EXPECT_EQ(lug->coupling, fem::InterfaceCoupling::point);
  EXPECT_DOUBLE_EQ(lug->radius, 0.05);
}

TEST(SceneFrame, ANodeTakesForcesAndPointsAtItsPositionButNothingThatTurnsWithIt)
{
  const std::string node = "[frame.interface.lug]\ncoupling = \"node\"\nposition = [1, 0, 0]\n";
  const auto        said = [&](const std::string &more)
  { return complaint(cad_scene("[frame.cut", node + more + "[frame.cut")); };
  EXPECT_EQ(said(""), "");
  EXPECT_EQ(said("[place.eye]\non = \"frame.lug\"\nat = [1, 0, 0]\n"
                 "[element.spring]\ntype = \"spring-damper\"\nfrom = \"frame.lug\"\ndirection = [1, 0, 0]\n"
                 "stiffness = 1e6\n"
                 "[body.load]\ntype = \"rigid\"\nmass = 3\ninertia = [1, 1, 1]\nposition = [1, 0, 0]\n"
                 "[joint.ball]\ntype = \"spherical\"\nfrom = \"frame.lug\"\nto = \"load\"\nat = [1, 0, 0]\n"
                 "[frame.mass.box]\nmass = 3\non = \"lug\"\n"),
            "");

  const std::vector<std::array<std::string, 2>> refused = {
      {"[place.eye]\non = \"frame.lug\"\nat = [1, 0, 0.1]\n", "place.eye"},
      {"[element.spring]\ntype = \"spring-damper\"\nfrom = \"frame.lug\"\nabout = [1, 0, 0]\nstiffness = 1e6\n",
       "element.spring"},
      {"[body.wheel]\ntype = \"rotor\"\naxis = [0, 1, 0]\ninertia = 1\non = \"frame.lug\"\n", "body.wheel"},
      {"[body.load]\ntype = \"rigid\"\nmass = 3\ninertia = [1, 1, 1]\nposition = [1, 0, 0]\n"
       "[joint.weld]\ntype = \"rigid\"\nfrom = \"frame.lug\"\nto = \"load\"\nat = [1, 0, 0]\n",
       "joint.weld"},
      {"[element.extra]\ntype = \"point mass\"\non = \"frame.lug\"\nmass = 3\noffset = [0, 0, 1]\n", "element.extra"},
      {"[measure.tilt]\ntype = \"angle\"\nfrom = \"frame.lug\"\nabout = [1, 0, 0]\n", "measure.tilt"}};
  for (const auto &[more, place] : refused)
  {
    const std::string message = said(more);
    EXPECT_NE(message.find(place), std::string::npos) << more << message;
    EXPECT_NE(message.find("'frame.lug' is a single node of the frame's mesh, which has no rotation"),
              std::string::npos)
        << more << message;
  }
}

TEST(SceneFrame, DampingByModeAndByFrequencyIsKeptAsItIsGiven)
{
  const auto ratios = [&](const std::string &ratio)
  { return scene_of(cad_scene("ratio = 0.02", ratio)).frame.geometry.modal_damping_ratio; };
  EXPECT_EQ(ratios("ratio = [0.01, \"2 %\"]").by_mode, (std::vector<double>{0.01, 0.02}));
  const auto table = ratios("ratio = [[\"20 Hz\", 0.01], [\"1 kHz\", 0.03]]").by_frequency;
  EXPECT_EQ(table, (std::vector<std::pair<double, double>>{{20., 0.01}, {1000., 0.03}}));
}

TEST(SceneFrame, AMaterialNoSolidHasIsTakenWithItsUnitAndGivesAWarning)
{
  const auto scene = scene_of(cad_scene("\"steel\"", "{ E = \"0.5 MPa\", nu = 0.45, rho = 1100 }"));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("frame.material.E: is 500000 Pa, softer than rubber"), std::string::npos)
      << scene.warnings[0];
}

TEST(SceneFrame, RepairIsADistanceAndADensityMayBeThatOfTheFile)
{
  const auto frame = [](const std::string &more)
  { return scene_of(cad_scene("[frame]\n", "[frame]\n" + more + '\n')).frame.geometry; };
  EXPECT_EQ(frame("").sew, 0.);
  EXPECT_DOUBLE_EQ(frame("repair = \"sew\"").sew, 5e-5);
  EXPECT_DOUBLE_EQ(frame("repair = { sew = \"0.2 mm\" }").sew, 2e-4);
  EXPECT_THAT(complaint(cad_scene("[frame]\n", "[frame]\nrepair = \"heal\"\n")),
              ::testing::HasSubstr("there is no 'heal'; valid: 'sew'"));
  EXPECT_EQ(frame("materials = { \"crown\" = { E = \"210 GPa\", nu = 0.3 } }").materials.at(0).second.rho, 0.);
}

TEST(Scene, OfNothingIsRefusedWhenItIsBuilt)
{
  tests::expect_refusal([] { apps::build_machine(scene_of("name = \"x\"\n")); },
                        "has no moving part; declare a [frame]");
}

TEST(Scene, WithGravityInAnotherUnitGivesAWarning)
{
  const auto scene = scene_of(small_scene(), {"gravity=[0, 0, -9810]"});
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("1000 times that of the Earth"), std::string::npos) << scene.warnings[0];
}

TEST(SceneFrame, MistakesAreReportedWithPlaceAndRemedy)
{
  const std::vector<std::array<std::string, 4>> cases = {
      {"ratio = 0.02", "ratio = [0.01, 2]", "scene.toml:5: frame.damping.ratio", "leaves no vibration"},
      {"ratio = 0.02", "ratio = [[\"20 Hz\", 0.01], [\"10 Hz\", 0.02]]", "frame.damping.ratio", "in ascending order"},
      {"\"steel\"", "{ E = 210, nu = 0.3, rho = 7850 }", "scene.toml:4: frame.material.E", "if 210 GPa was meant"},
      {"\"steel\"", "{ E = 210e3, nu = 0.3, rho = 7850 }", "scene.toml:4: frame.material.E", "if 210000 MPa was meant"},
      {"\"steel\"", "{ E = 210e9, nu = 0.3, rho = 7.85e-9 }", "scene.toml:4: frame.material.rho",
       "if 7.85e-09 t/mm^3 was meant, write it with its unit or as 7850 kg/m^3"},
      {"\"steel\"", "{ E = 210e9, nu = 0.3, rho = 7.85 }", "scene.toml:4: frame.material.rho",
       "if 7.85 g/cm^3 was meant, write it with its unit or as 7850 kg/m^3"},
      {"ratio = 0.02", "ratio = \"2 %^2\"", "scene.toml:5: frame.damping.ratio", "needs % without an exponent"},
      {"\"steel\"", "\"steel\"\nmaterials = { crown = \"cast irn\" }", "frame.materials.crown",
       "did you mean 'cast iron'"},
      {"stiffness = \"420 kN/mm\"", "stiffness = 1e8, stiffness_per_area = 1e9", "foundation.stiffness_per_area",
       "give one"},
      {"stiffness = \"420 kN/mm\"", "stiffness = 1e8, axes = [[1, 0, 0], [1, 1, 0]]", "foundation.axes",
       "perpendicular"},
      {"[frame.cut", "[frame.mass.motor]\nmass = 80\n[frame.cut", "frame.mass.motor", "either 'on'"},
      {"[frame.cut", "[frame.mass.motor]\nmass = 80\non = \"crwn\"\n[frame.cut", "frame.mass.motor.on",
       "did you mean 'crown'"},
      {"[frame.cut", "[frame.mass.motor]\nmass = 80\nsurface = \"bearing left\"\n[frame.cut", "frame.mass.motor",
       "is part of interface"},
      {"[frame.cut", "[frame.interface.two]\nsurface = \"feet\"\ncoupling = \"point\"\n[frame.cut",
       "frame.interface.two", "'position'"},
      {"[frame.cut", "[frame.interface.two]\ncoupling = \"node\"\n[frame.cut", "frame.interface.two", "'position'"},
      {"[frame.cut", "[frame.interface.two]\nsurface = \"feet\"\nradius = 0.1\n[frame.cut",
       "frame.interface.two.radius", "applies to coupling"},
      {"\"frame.step\"", "\"frame.stp\"", "scene.toml:2: frame.cad", "there is no file"},
      {"\"frame.step\"", "\"scene.toml\"", "scene.toml:2: frame.cad", "'.step'"},
      {"\"steel\"", "\"steal\"", "scene.toml:4: frame.material", "did you mean 'steel'"},
      {"\"steel\"", "{ E = 0, nu = 0.3, rho = 7850 }", "scene.toml:4: frame.material.E", "above zero"},
      {"\"steel\"", "{ E = 1e9, nu = 0.5, rho = 7850 }", "scene.toml:4: frame.material.nu", "below 0.5"},
      {"\"bearing *\"", "\"baering *\"", "scene.toml:3: frame.mesh.\"baering *\"", "name of a surface"},
      {"size = \"60 mm\"", "size = 0", "scene.toml:3: frame.mesh.size", "above zero"},
      {"surface    = \"feet\"", "surface = \"fet\"", "scene.toml:14: frame.support.feet.surface",
       "did you mean 'feet'"},
      {"faces = \"any\"", "faces = 0", "scene.toml:12: frame.surface.feet.faces", "1 or more"},
      {"foundation =", "clamped = true\nfoundation =", "scene.toml:13: frame.support.feet", "either"},
      {"stiffness = \"420 kN/mm\"", "stiffness = \"-1 N/m\"", "scene.toml:15: ", "zero or more"},
      {"left\", \"bearing right\"]\n", "left\", \"bearing left\"]\n", "scene.toml:17: frame.interface.crown.surfaces",
       "twice"},
      {"[frame.cut", "[frame.interface.two]\nsurfaces = \"bearing left\"\n[frame.cut",
       "scene.toml:18: ", "is part of interface"},
      {"foundation = { stiffness = \"420 kN/mm\", damping = [1, 2, 3] }", "clamped = true\ndirections = [\"w\"]",
       "scene.toml:16: frame.support.feet.directions", "no direction 'w'"},
      {"radius = \"120 mm\"", "radius = \"120 kg\"", "scene.toml:7: frame.surface.\"bearing left\".cylinder.radius",
       "length"},
      {"cylinder =", "cylindre =", "scene.toml:7: frame.surface.\"bearing left\"", "'cylinder'"},
      {"ratio = 0.02", "ratio = 2", "scene.toml:5: frame.damping.ratio", "0.01"},
      {"ratio = 0.02", "rayleigh = [{ frequency = 20, ratio = 0.01 }]", "damping.rayleigh", "needs two"},
      {"ratio = 0.02", "rayleigh = [{ frequency = 20, ratio = 0.01 }, { frequency = 40, ratio = 0.09 }]",
       "damping.rayleigh", "amplify"}};
  for (const auto &[piece, replacement, place, words] : cases)
  {
    const auto message = complaint(cad_scene(piece, replacement));
    EXPECT_NE(message.find(place), std::string::npos) << replacement << ": " << message;
    EXPECT_NE(message.find(words), std::string::npos) << replacement << ": " << message;
  }
}

} // namespace
} // namespace gestell::test

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

TEST(SceneFrame, SectionsAndStressPointsHaveSignals)
{
  const std::string points = "[frame.stress_point.root]\nat = [0, 0, \"1 m\"]\nalong = [0, 0, 2]\n"
                             "[frame.stress_point.web]\nat = [0, 0, 1]\n";
  const auto frame = scene_of(cad_scene("[frame.cut.columns]", points + "[frame.cut.columns]\nfirst = [1, 0, 0]\n"
                                                                        "about = [0, 0, \"1 m\"]\n"))
                         .frame.geometry;
  EXPECT_EQ(frame.cuts.at(0).first, (fem::Vector3{1., 0., 0.}));
  EXPECT_EQ(frame.cuts.at(0).about, (fem::Vector3{0., 0., 1.}));
  ASSERT_EQ(frame.stress_points.size(), 2u);
  EXPECT_EQ(frame.stress_points[0].at, (fem::Vector3{0., 0., 1.}));
  EXPECT_FALSE(frame.stress_points[1].along);
  const auto said = [&](const std::string &signal)
  { return complaint(cad_scene("[frame.cut", points + "[output.signals]\ns = \"" + signal + "\"\n[frame.cut")); };
  for (const char *signal : {"frame.cut.columns", "frame.cut.columns.M2", "frame.stress.root.xz",
                             "frame.stress.root.normal", "frame.stress.web.xx"})
    EXPECT_EQ(said(signal), "") << signal;
  EXPECT_NE(said("frame.stress.web.normal").find("there is no \"frame.stress.web.normal\""), std::string::npos);
  EXPECT_NE(complaint(cad_scene("[frame.cut", "[frame.stress_point.root]\n[frame.cut")).find("'at'"),
            std::string::npos);
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
    EXPECT_NE(message.find("'frame.lug' is a single mesh node without rotations"), std::string::npos)
        << more << message;
  }
}

TEST(SceneFrame, DampingByModeAndByFrequencyIsKeptAsItIsGiven)
{
  const auto ratios = [&](const std::string &ratio)
  { return scene_of(cad_scene("ratio = 0.02", ratio)).frame.geometry.modal_damping_ratio; };
  const auto list = ratios("ratio = [0.01, \"2 %\"]"); // the last one for all above
  ASSERT_EQ(list.named.size(), 1u);
  EXPECT_EQ(list.at(0, 1.), 0.01);
  EXPECT_EQ(list.at(1, 1.), 0.02);
  EXPECT_EQ(list.at(7, 1.), 0.02);
  const auto table = ratios("ratio = [[\"20 Hz\", 0.01], [\"1 kHz\", 0.03]]").by_frequency;
  EXPECT_EQ(table, (std::vector<std::pair<double, double>>{{20., 0.01}, {1000., 0.03}}));

  const auto both =
      ratios("ratio = 0.02, modes = [{ mode = 3, ratio = \"1.2 %\" }, { from = 50, to = \"1 kHz\", ratio = 0.03 }]");
  EXPECT_EQ(both.constant, 0.02);
  ASSERT_EQ(both.named.size(), 2u);
  EXPECT_EQ(both.named[0].mode, 2);
  EXPECT_EQ(both.named[0].ratio, 0.012);
  EXPECT_EQ(both.named[1].to, 1000.);
  EXPECT_FALSE(both.named[1].is_measured());
}

/// The measured modes of a file beside the scene.
std::vector<fem::NamedRatio> measured_in(const std::string &name, const std::string &text)
{
  const SceneFolder folder;
  folder.write(name, text);
  return scene_of(cad_scene("ratio = 0.02", "modes = [{ file = '" + folder.path(name) + "' }]"))
      .frame.geometry.modal_damping_ratio.named;
}

TEST(SceneFrame, MeasuredModesComeFromTablesAndUniversalFiles)
{
  const auto table = measured_in("m.csv", "ratio;frequency [Hz];mode\n0.01;20;\n0.02;;4\n");
  ASSERT_EQ(table.size(), 2u);
  EXPECT_TRUE(table[0].is_measured());
  EXPECT_EQ(table[0].from, 20.);
  EXPECT_EQ(table[1].mode, 3);

  const std::string nodes = "    -1\n  2411\n         7         1         1        11\n   1.0D+00   2.0D+00   3.0D+00\n"
                            "         9         1         1        11\n   4.0D+00   5.0D+00   6.0D+00\n    -1\n";
  const std::string head  = "    -1\n    55\nmode\nNONE\nNONE\nNONE\nNONE\n";
  const auto        normal = measured_in("m.uff", nodes + head +
                                                      "         1         2         2         8         2         3\n"
                                                             "         2         4         1         1\n"
                                                             "  4.12500E+01  1.00000E+00  1.20000E-02  0.00000E+00\n"
                                                             "         9\n  1.00000E+00-2.00000E+00  0.00000E+00\n    -1\n");
  ASSERT_EQ(normal.size(), 1u);
  EXPECT_EQ(normal[0].from, 41.25);
  EXPECT_EQ(normal[0].ratio, 0.012);
  EXPECT_EQ(normal[0].points, (std::vector<std::array<double, 3>>{{4., 5., 6.}}));
  EXPECT_EQ(normal[0].shape[1], std::complex<double>(-2.));
  const auto complex =
      measured_in("c.uff", nodes + head +
                               "         1         3         2         8         5         3\n"
                               "         2         6         1         1\n"
                               " -3.00000E+00  4.00000E+00  0.00000E+00  0.00000E+00  0.0E+00  0.0E+00\n"
                               "         7\n  1.0E+00  2.0E+00  0.0E+00  0.0E+00  3.0E+00 -1.0E+00\n    -1\n");
  EXPECT_NEAR(complex.at(0).from, 5. / (2. * M_PI), 1e-15); // |s| = 5, zeta = 3/5
  EXPECT_NEAR(complex.at(0).ratio, 0.6, 1e-15);
  EXPECT_EQ(complex.at(0).shape[2], std::complex<double>(3., -1.));

  tests::expect_refusal([] { measured_in("bad.csv", "frequency [Hz],damping\n20,0.01\n"); },
                        "bad.csv:1: needs the columns");
  tests::expect_refusal([] { measured_in("much.csv", "frequency [Hz],ratio\n20,1.5\n"); },
                        "much.csv:2: the damping ratio is 1.5");
  tests::expect_refusal([] { measured_in("twice.csv", "ratio,mode\n0.01,1\n0.02,2\n0.03,1\n"); },
                        "twice.csv:4: gives mode 1 a second ratio, after ");
  tests::expect_refusal([] { measured_in("none.csv", "frequency [Hz],ratio\n"); }, "contains no modes");
  tests::expect_refusal([&] { measured_in("none.uff", nodes); }, "none.uff: contains no modes");
  tests::expect_refusal(
      [&]
      {
        measured_in("node.uff", nodes + head +
                                    "         1         2         2         8         2         3\n"
                                    "         2         4         1         1\n  4.1E+01  1.0E+00  1.2E-02  0.0E+00\n"
                                    "         8\n  1.0E+00  2.0E+00  0.0E+00\n    -1\n");
      },
      "node 8 has no coordinates");
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
      {"ratio = 0.02", "modes = []", "scene.toml:5: frame.damping.modes", "is empty"},
      {"ratio = 0.02", "modes = [{ mode = 0, ratio = 0.01 }]", "frame.damping.modes",
       "the first elastic mode of the frame is 1"},
      {"ratio = 0.02", "modes = [{ mode = 1, ratio = 1 }]", "frame.damping.modes", "leaves no vibration"},
      {"ratio = 0.02", "modes = [{ mode = 1, ratio = -0.1 }]", "frame.damping.modes", "zero or more"},
      {"ratio = 0.02", "modes = [{ mode = 1 }]", "frame.damping.modes", "ratio"},
      {"ratio = 0.02", "modes = [{ ratio = 0.1 }]", "frame.damping.modes", "either `mode`"},
      {"ratio = 0.02", "modes = [{ mode = 1, ratio = 0.1 }, { mode = 1, ratio = 0.2 }]", "frame.damping.modes",
       "a second ratio"},
      {"ratio = 0.02", "modes = [{ from = 9, to = 9, ratio = 0.1 }]", "frame.damping.modes", "above `from`"},
      {"ratio = 0.02", "modes = [{ from = 10, to = 30, ratio = 0.1 }, { from = 20, to = 40, ratio = 0.1 }]",
       "frame.damping.modes", "from 20 to 30 Hz that another row covers"},
      {"ratio = 0.02", "modes = [{ file = \"none.csv\" }]", "frame.damping.modes", "there is no file"},
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

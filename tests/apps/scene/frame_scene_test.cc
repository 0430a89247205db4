#include "apps/scene/build/build_machine.h"
#include "tests/support/scene_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

namespace gestell::test
{
namespace
{

TEST(SceneFrame, MassesMaterialsAndPointsBecomeTheSpecification)
{
  const SceneFolder folder;
  folder.write("frame.step", "ISO-10303-21;");
  const auto text =
      cad_scene("[frame.cut", "[frame.materials]\n\"crown *\" = \"cast iron\"\n"
                              "[frame.mass.motor]\nmass = \"80 kg\"\non = \"frame.crown\"\n"
                              "inertia = [1, 2, 2.5]\nposition = [0, 0, \"2 m\"]\n"
                              "[frame.mass.weight]\nmass = 30\nsurface = \"feet\"\ncoupling = \"average\"\n"
                              "[frame.interface.lug]\nsurface = \"feet\"\ncoupling = \"point\"\n"
                              "position = [1, 0, 0]\nradius = \"50 mm\"\n[frame.cut");
  const auto frame = apps::read_scene(folder.write("scene.toml", text)).frame.geometry;
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
  const auto        with = [&](const std::string &more)
  {
    const SceneFolder folder;
    folder.write("frame.step", "ISO-10303-21;");
    try
    {
      apps::check_scene(
          apps::read_scene(folder.write("scene.toml", cad_scene("[frame.cut", node + more + "[frame.cut"))));
    }
    catch (const std::invalid_argument &error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(with(""), "");
  EXPECT_EQ(with("[place.eye]\non = \"frame.lug\"\nat = [1, 0, 0]\n"
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
    const std::string message = with(more);
    EXPECT_NE(message.find(place), std::string::npos) << more << message;
    EXPECT_NE(message.find("'frame.lug' is a single node of the frame's mesh, which has no rotation"),
              std::string::npos)
        << more << message;
  }
}

TEST(SceneFrame, DampingByModeAndByFrequencyIsKeptAsItIsGiven)
{
  const SceneFolder folder;
  folder.write("frame.step", "ISO-10303-21;");
  const auto ratios = [&](const std::string &ratio)
  {
    return apps::read_scene(folder.write("scene.toml", cad_scene("ratio = 0.02", ratio)))
        .frame.geometry.modal_damping_ratio;
  };
  EXPECT_EQ(ratios("ratio = [0.01, \"2 %\"]").by_mode, (std::vector<double>{0.01, 0.02}));
  const auto table = ratios("ratio = [[\"20 Hz\", 0.01], [\"1 kHz\", 0.03]]").by_frequency;
  EXPECT_EQ(table, (std::vector<std::pair<double, double>>{{20., 0.01}, {1000., 0.03}}));
}

TEST(SceneFrame, AMaterialNoSolidHasIsTakenWithItsUnitAndWarnedOf)
{
  const SceneFolder folder;
  folder.write("frame.step", "ISO-10303-21;");
  const auto scene = apps::read_scene(
      folder.write("scene.toml", cad_scene("\"steel\"", "{ E = \"0.5 MPa\", nu = 0.45, rho = 1100 }")));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("frame.material.E: is 500000 Pa, softer than rubber"), std::string::npos)
      << scene.warnings[0];
}

TEST(Scene, OfNothingIsRefusedWhenItIsBuilt)
{
  try
  {
    const SceneFolder folder;
    apps::build_machine(apps::read_scene(folder.write("scene.toml", "name = \"x\"\n")));
    FAIL() << "built from nothing";
  }
  catch (const std::invalid_argument &refusal)
  {
    EXPECT_NE(std::string(refusal.what()).find("has nothing that moves; declare a [frame]"), std::string::npos)
        << refusal.what();
  }
}

TEST(Scene, WithGravityInAnotherUnitIsWarnedOf)
{
  const SceneFolder folder;
  const auto        scene = apps::read_scene(folder.write("scene.toml", small_scene()), {"gravity=[0, 0, -9810]"});
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_NE(scene.warnings[0].find("1000 times that of the earth"), std::string::npos) << scene.warnings[0];
}

TEST(SceneFrame, MistakesInMassesMaterialsAndDampingAreReportedWithPlaceAndRemedy)
{
  const std::vector<std::array<std::string, 4>> cases = {
      {"ratio = 0.02", "ratio = [0.01, 2]", "scene.toml:5: frame.damping.ratio", "leaves no vibration"},
      {"ratio = 0.02", "ratio = [[\"20 Hz\", 0.01], [\"10 Hz\", 0.02]]", "frame.damping.ratio", "grow from row to row"},
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
       "right angles"},
      {"[frame.cut", "[frame.mass.motor]\nmass = 80\n[frame.cut", "frame.mass.motor", "either 'on'"},
      {"[frame.cut", "[frame.mass.motor]\nmass = 80\non = \"crwn\"\n[frame.cut", "frame.mass.motor.on",
       "did you mean 'crown'"},
      {"[frame.cut", "[frame.mass.motor]\nmass = 80\nsurface = \"bearing left\"\n[frame.cut", "frame.mass.motor",
       "belongs to interface"},
      {"[frame.cut", "[frame.interface.two]\nsurface = \"feet\"\ncoupling = \"point\"\n[frame.cut",
       "frame.interface.two", "'position'"},
      {"[frame.cut", "[frame.interface.two]\ncoupling = \"node\"\n[frame.cut", "frame.interface.two", "'position'"},
      {"[frame.cut", "[frame.interface.two]\nsurface = \"feet\"\nradius = 0.1\n[frame.cut",
       "frame.interface.two.radius", "belongs to coupling"}};
  for (const auto &[piece, replacement, place, words] : cases)
  {
    const auto message = cad_complaint(piece, replacement);
    EXPECT_NE(message.find(place), std::string::npos) << replacement << ": " << message;
    EXPECT_NE(message.find(words), std::string::npos) << replacement << ": " << message;
  }
}

} // namespace
} // namespace gestell::test

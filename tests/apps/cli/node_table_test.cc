// Matrices of other programs: what a table of nodes adds, and what is refused or warned of.

#include "apps/scene/build/build_machine.h"
#include "apps/scene/read/frame/matrix_units.h"
#include "coupling/reduction/dense_frame.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell;

const std::string matrices = R"(
mass      = [[100, 0, 0, 0], [0, 5, 0, 0], [0, 0, 100, 0], [0, 0, 0, 5]]
stiffness = [[2e6, 0, -1e6, 0], [0, 3e5, 0, 0], [-1e6, 0, 1e6, 0], [0, 0, 0, 2e5]]
)";

const std::string table = "name; x [mm]; y [mm]; z [mm]; uz; ry\r\n"
                          "# of a spreadsheet\r\n"
                          "top; 500; 0; 2400; -3; 4\r\n"
                          ";0;0;0;1;2\r\n";

/// A folder with a table of nodes and a scene that names it.
class NodeTable : public ::testing::Test
{
protected:
  test::SceneFolder folder;

  apps::Scene read(const std::string &nodes, const std::string &more = "nodes = \"nodes.csv\"\n",
                   const std::string &of = matrices) const
  {
    folder.write("nodes.csv", nodes);
    return apps::read_scene(folder.write("scene.toml", "[frame]\n" + of + more));
  }
  std::string complaint(const std::string &nodes, const std::string &more = "nodes = \"nodes.csv\"\n",
                        const std::string &of = matrices) const
  {
    return tests::refusal([&] { read(nodes, more, of); });
  }
  static void expect(const std::string &text, const std::vector<std::string> &words)
  {
    for (const auto &word : words)
      EXPECT_NE(text.find(word), std::string::npos) << "no '" << word << "' in: " << text;
  }
};

TEST_F(NodeTable, NamesInterfacesAndKnowsHowTheFrameIsShifted)
{
  const auto  scene = read(table);
  const auto &frame = scene.frame.matrices;
  ASSERT_EQ(frame.interfaces.size(), 1u);
  const auto &top = frame.interfaces[0];
  EXPECT_EQ(top.name, "top");
  EXPECT_EQ(top.position, (std::array<double, 3>{0.5, 0., 2.4}));
  EXPECT_EQ(top.coordinate, (std::array<int, 6>{-1, -1, 2, -1, 3, -1}));
  EXPECT_EQ(top.sign[fem::uz], -1.);
  EXPECT_TRUE(scene.frame.has_translations); // every row is a motion of some node
  EXPECT_EQ(frame.translations.col(2), Eigen::Vector4d(1., 0., -1., 0.));
  EXPECT_EQ(frame.mass, 200.);
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
}

TEST_F(NodeTable, DrawsTheFrame)
{
  folder.write("triangles.csv", "a,b,c,d\n1,2,1,\n2,1,2,1\n");
  const auto dense =
      coupling::dense_frame(read(table, "nodes = \"nodes.csv\"\ntriangles = \"triangles.csv\"\n").frame.matrices);
  ASSERT_EQ(dense.points.size(), 2u);
  EXPECT_EQ(dense.points[0][2], 2.4);
  EXPECT_EQ(dense.triangles.size(), 3u); // a quadrilateral is two
  ASSERT_EQ(dense.displacement.rows(), 6);
  EXPECT_EQ(dense.displacement(2, 0), -1.F); // the interface comes first in q
  EXPECT_EQ(dense.displacement(5, 2), 1.F);
  EXPECT_EQ(dense.displacement.cwiseAbs().sum(), 2.F);
}

TEST_F(NodeTable, MistakesAreReportedWithFileLineAndRemedy)
{
  const std::string head = "name,x,y,z,uz\n";
  expect(complaint("name,x,y,w\n"), {"scene.toml:", "nodes.csv:1: column 'w'", "valid: "});
  expect(complaint("name,x,y,x\n"), {"is a duplicate"});
  expect(complaint("name,x,y,uz\n"), {"has no column 'z'"});
  expect(complaint("name,x [kg],y,z\n"), {"'x [kg]'", "unit of length"});
  expect(complaint(""), {"is empty"});
  expect(complaint(head + "top,0,0,0\n"), {"nodes.csv:2: has 4 cells", "instead of 5"});
  expect(complaint(head + "top,0,0,one,3\n"), {"nodes.csv:2: column 'z'", "'one'"});
  expect(complaint(head + "top,0,0,nan,3\n"), {"'nan'"});
  expect(complaint(head + "top,0,0,0,1.5\n"), {"integer"});
  expect(complaint(head + "top,0,0,0,5\n"), {"there is no row 5; the matrices have rows 1 to 4"});
  expect(complaint(head + "top,0,0,0,\n"), {"has no row"});
  expect(complaint(head + "top,0,0,0,1\ntop,0,0,0,2\n"), {"nodes.csv:3: node 'top' already exists", "nodes.csv:2"});
  expect(complaint(head + "top,0,0,0,1\nfoot,0,0,0,-1\n"), {"row 1, which is top.uz already"});
  expect(complaint(head + "a.b,0,0,0,1\n"), {"must not contain dots"});
  expect(complaint(head + ",0,0,0,1\n"), {"has no interface"});
  const std::string nodes = "nodes = \"nodes.csv\"\n";
  expect(complaint(table, nodes + "[frame.interface.top]\nrows = { uz = 1 }\n"), {"; rename one"});
  expect(complaint(table, "triangles = \"nodes.csv\"\n[frame.interface.a]\nrows = { uz = 1 }\n"), {"add nodes"});
  folder.write("triangles.csv", "a,b,c\n1,2,3\n");
  expect(complaint(table, nodes + "triangles = \"triangles.csv\"\n"), {"triangles.csv:2: there is no node 3"});
  folder.write("d.mtx", "%%MatrixMarket matrix array real general\n1 1\n1\n");
  expect(complaint(table, nodes + "node_displacements = \"d.mtx\"\n"), {"is 1 x 1, but must be 6 x 4"});
}

TEST_F(NodeTable, MatricesThatCannotBeAFrameAreReportedWithTheirRow)
{
  const auto with = [&](const std::string &mass, const std::string &stiffness)
  {
    return complaint(table, "[frame.interface.a]\nrows = { uz = 1 }\n",
                     "mass = " + mass + "\nstiffness = " + stiffness + "\n");
  };
  const std::string unit = "[[1, 0], [0, 1]]";
  expect(with(unit, "[[2, 1], [3, 2]]"), {"stiffness", "row 2, column 1 is 3, but row 1, column 2 is 1"});
  expect(with(unit, "[[2, 0], [-1, 2]]"), {"one triangle", "symmetric"});
  expect(with("[[1, 0], [0, -1]]", unit), {"mass", "row 2"});
  expect(with("[[1, 2], [2, 1]]", unit), {"mass", "negative"});
  expect(with("[[1, 0], [0, 0]]", "[[1, 0], [0, 0]]"), {"row 2 has neither mass nor stiffness"});
  expect(with("[[1, 0, 0], [0, 1, 0]]", unit), {"2 x 3", "square"});
  expect(with(unit, "[[1]]"), {"1 x 1", "2 x 2"});
}

TEST_F(NodeTable, UnitsThatCannotBeGiveAWarning)
{
  const std::string nodes   = "nodes = \"nodes.csv\"\n";
  const auto        warning = [&](const std::string &table_text, const std::string &of)
  {
    const auto scene = read(table_text, nodes, of);
    return scene.warnings.empty() ? std::string("no warning") : scene.warnings[0];
  };
  const auto scaled = [](double mass, double turning_stiffness)
  {
    const auto m = std::to_string(mass), c = std::to_string(turning_stiffness);
    return "mass = [[" + m + ", 0, 0], [0, " + m +
           ", 0], [0, 0, 1]]\nstiffness = [[2e6, -1e6, 0], [-1e6, 1e6, 0], [0, 0, " + c + "]]\n";
  };
  const auto at = [](const std::string &height) { return "name,x,y,z,uz,ry\ntop,1,0," + height + ",2,3\n,0,1,0,1,\n"; };
  EXPECT_EQ(warning(at("2"), scaled(500., 1e5)), "no warning");
  expect(warning(at("2000"), scaled(500., 1e5)), {"mass", "2e+03 m", "x [mm]"});
  expect(warning(at("2"), scaled(0.5, 1e5)), {"lighter than the air", "tonnes"}); // 1 kg in 2 m^3
  expect(warning(at("2"), scaled(5e4, 1e5)), {"heavier than any metal"});
  expect(warning(at("2"), scaled(500., 1e11)), {"interface top", "N mm"});
}

/// A steel rod of 0.01 m^2 in pieces of 0.1 m, clamped at one end, free at the other; units of mass and stiffness.
fem::FrameMatrices rod(double kg, double newton_per_metre, std::vector<fem::Interface> &nodes)
{
  constexpr int      n = 30;
  fem::FrameMatrices frame;
  frame.M.resize(n, n);
  frame.C.resize(n, n);
  for (int i = 0; i < n; ++i)
  {
    frame.M.insert(i, i) = 7.85 * (i < n - 1 ? 1. : 0.5) / kg;
    frame.C.insert(i, i) = 2.1e10 * (i < n - 1 ? 2. : 1.) / newton_per_metre;
    if (i > 0)
      frame.C.insert(i - 1, i) = frame.C.insert(i, i - 1) = -2.1e10 / newton_per_metre;
    nodes.push_back({"", {0.1 * (i + 1), 0., 0.}, {i, -1, -1, -1, -1, -1}});
  }
  frame.interfaces = {nodes.back()};
  frame.picture.points.resize(1); // the clamped end
  return frame;
}

TEST_F(NodeTable, SpeedOfWavesAndTheLowestFrequencyTellMassesInTonnes)
{
  for (const double kg : {1., 1000.})
  {
    std::vector<fem::Interface> nodes;
    const fem::FrameMatrices    frame = rod(kg, 1., nodes);
    const auto                  units = apps::suspect_units(frame, nodes);
    // A rod is the stiffest body of its length: its lowest frequency is c / 4 L, and 32 times that none has.
    coupling::ReducedFrame reduced;
    reduced.points              = frame.picture.points;
    reduced.interfaces          = frame.interfaces;
    reduced.frequencies_hz      = Eigen::Vector2d(0., std::sqrt(2.1e11 / 7850. * kg) / 12.);
    const std::string frequency = apps::suspect_frequency(reduced);
    EXPECT_EQ(units.size(), kg > 1. ? 1u : 0u);
    EXPECT_EQ(frequency.empty(), kg == 1.) << frequency;
    if (kg > 1.)
    {
      expect(units.at(0), {"waves", "tonnes"});
      expect(frequency, {"tonnes"});
    }
  }
  // Tonnes and N/mm fit: frequencies are right, and so is the speed.
  std::vector<fem::Interface> nodes;
  const fem::FrameMatrices    consistent = rod(1000., 1000., nodes);
  EXPECT_TRUE(apps::suspect_units(consistent, nodes).empty());
}

TEST_F(NodeTable, MassAndStiffnessExchangedAreReportedByFrequenciesNoFrameHas)
{
  const auto warnings = read(table, "nodes = \"nodes.csv\"\n",
                             "stiffness = [[100, 0, 0, 0], [0, 5, 0, 0], [0, 0, 100, 0], [0, 0, 0, 5]]\n"
                             "mass      = [[2e6, 0, -1e6, 0], [0, 3e5, 0, 0], [-1e6, 0, 1e6, 0], [0, 0, 0, 2e5]]\n")
                            .warnings;
  ASSERT_FALSE(warnings.empty());
  expect(warnings[0], {"0.00159 Hz", "exchanged"});
}

TEST_F(NodeTable, AMassThatCountsNamedRowsOnlyIsNotThatOfTheFrame)
{
  const std::string some = "[frame.interface.top]\nrows = { uz = 3 }\n";
  const auto        part = read(table, some).frame.matrices;
  EXPECT_EQ(part.mass, 0.);
  ASSERT_EQ(part.statements.size(), 1u);
  expect(part.statements[0], {"unknown", "translations", "total_mass"});
  EXPECT_EQ(read(table, "total_mass = \"250 kg\"\n" + some).frame.matrices.mass, 250.);
  EXPECT_EQ(read(table).frame.matrices.mass, 200.) << "every row is that of a node";
}

} // namespace

// The same frame through every format of other programs has the same matrices, frequencies and motion as through
// MatrixMarket, to the digits of the format; units, nodes, and what is told of pairings that are wrong.

#include "apps/scene/build/build_machine.h"
#include "coupling/simulation/simulation.h"
#include "fem/values/number_text.h"
#include "tests/support/lumped_frame.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace gestell;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const tests::LumpedFrame held = tests::lumped_frame(true), loose = tests::lumped_frame(false);

/// A frame as files and the keys that name them.
struct Import
{
  std::string                                      name;
  std::vector<std::pair<std::string, std::string>> files;
  std::string                                      keys;
  double                                           digits; ///< what the format leaves, as a share
};

std::string cards(const tests::LumpedFrame &frame, tests::CardFields fields = tests::CardFields::large)
{
  return tests::grid_text(frame) + tests::dmig_text("KAAX", frame.C, frame.rows, fields) +
         tests::dmig_text("MAAX", frame.M, frame.rows, fields);
}

const std::string on_cards = "mass = 'a.pch'\nstiffness = 'a.pch'\n";

std::vector<Import> imports(const tests::LumpedFrame &frame)
{
  using tests::CardFields;
  const std::string rows = "rows = 'a.rows'\nnodes = 'a.nodes'\n";
  return {{"DMIG, free", {{"a.pch", cards(frame, CardFields::free_)}}, on_cards, 1e-12},
          {"DMIG, large", {{"a.pch", cards(frame)}}, on_cards, 2e-8},
          {"DMIG, small", {{"a.pch", cards(frame, CardFields::small_)}}, on_cards, 2e-2},
          {"CalculiX",
           {{"a.sti", tests::indexed_text(frame.C)},
            {"a.mas", tests::indexed_text(frame.M)},
            {"a.rows", tests::dof_text(frame.rows)},
            {"a.nodes", tests::inp_text(frame)}},
           "mass = 'a.mas'\nstiffness = 'a.sti'\n" + rows,
           1e-11},
          {"substructure",
           {{"a.mtx", tests::element_matrix_text({{"STIFFNESS", frame.C}, {"MASS", frame.M}}, frame.rows, true)},
            {"a.nodes", tests::inp_text(frame)}},
           "mass = 'a.mtx'\nstiffness = 'a.mtx'\nnodes = 'a.nodes'\n",
           1e-11},
          {"Ansys, Harwell-Boeing",
           {{"K", tests::harwell_boeing_text(frame.C, true)},
            {"M", tests::harwell_boeing_text(frame.M, false)},
            {"a.rows", tests::mapping_text(frame.rows)},
            {"a.nodes", tests::nblock_text(frame)}},
           "mass = 'M'\nstiffness = 'K'\n" + rows,
           1e-12},
          {"Ansys, MatrixMarket",
           {{"K", tests::matrix_market_text(frame.C)},
            {"M", tests::matrix_market_text(frame.M)},
            {"a.rows", tests::mapping_text(frame.rows)},
            {"a.nodes", tests::node_table_text(frame, "m", false)}},
           "mass = 'M'\nstiffness = 'K'\n" + rows,
           1e-12}};
}

struct ImportedFrame : ::testing::Test
{
  test::SceneFolder folder;

  apps::Scene read(const std::string &keys, const std::string &interfaces = node_interface) const
  {
    return apps::read_scene(folder.write("scene.toml", test::quoted("[frame]\n" + keys + interfaces)));
  }
  apps::Scene read(const Import &import, const std::string &more = "", const std::string &after = node_interface) const
  {
    for (const auto &[name, text] : import.files)
      folder.write(name, text);
    return read(import.keys + more, after);
  }
  static void expect(const std::string &text, const std::vector<std::string> &words)
  {
    for (const auto &word : words)
      EXPECT_NE(text.find(word), std::string::npos) << "no '" << word << "' in: " << text;
  }
  /// What is said against keys beside files.
  void refused(const std::string &keys, const std::vector<std::string> &words,
               const std::string &interfaces = node_interface) const
  {
    expect(tests::refusal([&] { read(keys, interfaces); }), words);
  }

  static constexpr const char *node_interface = "[frame.interface.top]\nnode = 12\n";
};

/// [Hz] of the whole frame, ascending.
VectorXd frequencies(const MatrixXd &C, const MatrixXd &M)
{
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(C, M, Eigen::EigenvaluesOnly);
  return modes.eigenvalues().cwiseMax(0.).cwiseSqrt() / (2. * M_PI);
}

VectorXd frequencies(const apps::Scene &scene)
{
  return frequencies(MatrixXd(scene.frame.matrices.C), MatrixXd(scene.frame.matrices.M));
}

double largest_ratio(const VectorXd &a, const VectorXd &b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

TEST_F(ImportedFrame, HasTheFrequenciesOfItsMatricesThroughEachFormat)
{
  const VectorXd known = frequencies(held.C, held.M);
  for (const Import &import : imports(held))
  {
    const auto scene = read(import);
    EXPECT_LT(largest_ratio(frequencies(scene), known), import.digits) << import.name;
    EXPECT_NEAR(scene.frame.matrices.mass, held.mass, import.digits * held.mass) << import.name;
    EXPECT_TRUE(scene.warnings.empty()) << import.name << ": " << scene.warnings[0];
    EXPECT_TRUE(scene.frame.has_translations);
  }
}

/// The top under gravity, after a hundredth of a second.
Eigen::Vector3d moved_top(const apps::Scene &scene)
{
  coupling::Machine machine = apps::build_machine(scene);
  const auto        result  = coupling::simulate(machine, apps::initial_state(scene, machine), scene.run.options,
                                                 apps::scene_signals(scene, machine));
  EXPECT_EQ(result.failure, "");
  return {result.signals.at(0).final, result.signals.at(1).final, result.signals.at(2).final};
}

const std::string falling = "[run]\nmethod = 'newmark'\nstep = '50 us'\nend = '10 ms'\n[output.signals]\n"
                            "x = 'frame.top.ux'\ny = 'frame.top.uy'\nr = 'frame.top.rx'\n";

TEST_F(ImportedFrame, MovesAsThroughMatrixMarket)
{
  const auto moves = [&](const std::string &keys, const std::string &interface)
  {
    return moved_top(apps::read_scene(
        folder.write("scene.toml", test::quoted("gravity = [1, 2, -9.81]\n[frame]\n" + keys + interface + falling))));
  };
  folder.write("K.mtx", tests::matrix_market_text(held.C));
  folder.write("M.mtx", tests::matrix_market_text(held.M));
  std::string unit = "translations = [";
  for (const auto &[node, direction] : held.rows)
    unit += std::string("[") + (direction == 1 ? "1" : "0") + "," + (direction == 2 ? "1" : "0") + "," +
            (direction == 3 ? "1" : "0") + "],";
  const Eigen::Vector3d known =
      moves("mass = 'M.mtx'\nstiffness = 'K.mtx'\n" + unit + "]\n",
            "[frame.interface.top]\nrows = { ux = 7, uy = 8, uz = 9, rx = 10, ry = 11, rz = 12 }\n");
  ASSERT_GT(known.cwiseAbs().minCoeff(), 1e-7);
  for (const Import &import : imports(held))
  {
    for (const auto &[name, text] : import.files)
      folder.write(name, text);
    EXPECT_LT((moves(import.keys, node_interface) - known).norm(), import.digits * known.norm()) << import.name;
  }
}

TEST_F(ImportedFrame, InTonnesAndMillimetresIsTheSameMachine)
{
  for (const auto &frame : {held, loose, tests::craig_bampton_frame(loose, 6)})
  {
    const auto  si = read({"", {{"a.pch", cards(frame, tests::CardFields::free_)}}, on_cards, 0.});
    const auto  mm = read({"", {{"a.pch", cards(frame.in_units(1e-3, 1e3), tests::CardFields::free_)}}, on_cards, 0.},
                          "file_units = { length = '1 mm', mass = '1 t' }\n");
    const auto &a = si.frame.matrices, &b = mm.frame.matrices;
    EXPECT_LT((MatrixXd(a.M) - MatrixXd(b.M)).cwiseAbs().maxCoeff(), 1e-12 * MatrixXd(a.M).maxCoeff());
    EXPECT_LT((MatrixXd(a.C) - MatrixXd(b.C)).cwiseAbs().maxCoeff(), 1e-12 * MatrixXd(a.C).maxCoeff());
    EXPECT_LT((a.translations - b.translations).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_NEAR(a.mass, b.mass, 1e-9 * a.mass);
    EXPECT_NEAR(a.interfaces[0].position[0], b.interfaces[0].position[0], 1e-12);
    EXPECT_TRUE(mm.warnings.empty()) << mm.warnings[0];
  }
  // Forces of their own beside lengths and masses: kg, mm, N.
  auto mixed       = held.in_units(1e-3, 1.);
  mixed.C          = mixed.C * 1e-3; // kg mm/s^2 are mN
  const auto scene = read({"", {{"a.pch", cards(mixed, tests::CardFields::free_)}}, on_cards, 0.},
                          "file_units = { length = '1 mm', force = '1 N' }\n");
  EXPECT_LT(largest_ratio(frequencies(scene), frequencies(held.C, held.M)), 1e-12);
}

TEST_F(ImportedFrame, OfNodesWithAxesOfTheirOwnIsTurnedToTheGlobalOnes)
{
  // System 5 lies in 4, whose origin is [0, 0, 1] and whose axes x, y, z are the basic y, z, x.
  const std::string systems = "CORD2R,4,0,0.,0.,1.,1.,0.,1.,\n,0.,1.,1.\n"
                              "CORD2R,5,4,0.,0.,0.,0.,0.,1.,\n,1.,0.,0.\n";
  Eigen::Matrix3d   axes;
  axes << 0., 0., 1., 1., 0., 0., 0., 1., 0.;
  auto     local      = held;
  MatrixXd G          = MatrixXd::Identity(24, 24); // u = G u' of node 12
  G.block<3, 3>(6, 6) = G.block<3, 3>(9, 9) = axes;
  local.M                                   = G.transpose() * held.M * G;
  local.C                                   = G.transpose() * held.C * G;
  const std::string matrices                = tests::dmig_text("KAAX", local.C, local.rows, tests::CardFields::free_) +
                               tests::dmig_text("MAAX", local.M, local.rows, tests::CardFields::free_);
  const std::string others = "GRID,11,,0.,0.,0.\nGRID,23,,0.2,0.9,0.3\nGRID,7,,0.4,0.3,1.5\n";
  folder.write("a.pch", systems + others + "GRID,12,5,0.1,-1.,1.2,5\n" + matrices); // at [1.2, 0.1, 0]
  folder.write("b.pch", cards(held, tests::CardFields::free_));
  const auto turned = read(on_cards).frame.matrices;
  const auto known  = read("mass = 'b.pch'\nstiffness = 'b.pch'\n").frame.matrices;
  EXPECT_LT((MatrixXd(turned.C) - MatrixXd(known.C)).cwiseAbs().maxCoeff(), 1e-15 * MatrixXd(known.C).maxCoeff());
  EXPECT_LT((MatrixXd(turned.M) - MatrixXd(known.M)).cwiseAbs().maxCoeff(), 1e-15 * MatrixXd(known.M).maxCoeff());
  for (int d = 0; d < 3; ++d)
    EXPECT_NEAR(turned.interfaces[0].position[d], known.interfaces[0].position[d], 1e-15);
  // Places from elsewhere: the axes still are those on the cards, wherever these stand.
  folder.write("nodes.csv", tests::node_table_text(held, "m", false));
  for (const std::string nodes : {"nodes = 'nodes.csv'\n", "nodes = 'b.pch'\n"})
  {
    if (nodes == "nodes = 'b.pch'\n")
    {
      refused(on_cards + nodes, {"nodes", "node 12 counts its motions in another system in", "a.pch"});
      continue;
    }
    const auto placed = read(on_cards + nodes).frame.matrices;
    EXPECT_LT((MatrixXd(placed.C) - MatrixXd(known.C)).cwiseAbs().maxCoeff(), 1e-15 * MatrixXd(known.C).maxCoeff());
  }
  folder.write("K.pch", tests::dmig_text("KAAX", local.C, local.rows, tests::CardFields::free_));
  const auto by_mass = read("mass = 'a.pch'\nstiffness = 'K.pch'\nnodes = 'nodes.csv'\n").frame.matrices;
  EXPECT_LT((MatrixXd(by_mass.C) - MatrixXd(known.C)).cwiseAbs().maxCoeff(), 1e-15 * MatrixXd(known.C).maxCoeff());
  folder.write("a.pch", systems + others + "GRID,12,5,0.1,-1.,1.2,6\n" + matrices);
  refused(on_cards + "nodes = 'nodes.csv'\n", {"grid point 12", "CD", "no CORD2R"});
  folder.write("a.pch", systems + others + "GRID,12,6,0.1,-1.,1.2,5\n" + matrices); // no matter where: the table tells
  EXPECT_NO_THROW(read(on_cards + "nodes = 'nodes.csv'\n"));
  folder.write("a.pch", systems + "GRID,12,,0.,0.,0.,5\nDMIG,KAAX,0,6,2\nDMIG,KAAX,12,1,,12,1,1.\n"
                                  "DMIG,MAAX,0,6,2\nDMIG,MAAX,12,1,,12,1,1.\n");
  refused(on_cards, {"node 12 counts its motions along axes of its own", "node 12, uy has no row"});
}

TEST_F(ImportedFrame, HasOnePlaceOfEachNode)
{
  folder.write("a.pch", cards(held, tests::CardFields::free_));
  folder.write("nodes.csv", tests::node_table_text(held, "m", false));
  EXPECT_TRUE(read(on_cards + "nodes = 'nodes.csv'\n").warnings.empty());
  folder.write("nodes.csv", tests::node_table_text(held, "mm", false)); // numbers of metres
  const auto said = tests::refusal([&] { read(on_cards + "nodes = 'nodes.csv'\n"); });
  expect(said, {"nodes", "node ", " is at [", ", but at [", "in other units"});
}

TEST_F(ImportedFrame, TakesMatricesOfTheSceneInSiBesideFilesInOtherUnits)
{
  const auto mm = held.in_units(1e-3, 1e3);
  folder.write("a.pch", tests::grid_text(mm) + tests::dmig_text("KAAX", mm.C, mm.rows, tests::CardFields::free_));
  folder.write("a.dof", tests::dof_text(held.rows));
  std::string written = "[";
  for (Eigen::Index i = 0; i < 24; ++i)
  {
    written += "[";
    for (Eigen::Index j = 0; j < 24; ++j)
      written += std::to_string(held.M(i, j)) + ",";
    written += "],";
  }
  const auto frame = read("mass = " + written +
                          "]\nstiffness = 'a.pch'\nrows = 'a.dof'\n"
                          "file_units = { length = '1 mm', mass = '1 t' }\n")
                         .frame.matrices;
  EXPECT_NEAR(frame.mass, held.mass, 1e-5 * held.mass) << "six decimals";
  folder.write("b.pch", cards(held, tests::CardFields::free_));
  const auto known = read("mass = 'b.pch'\nstiffness = 'b.pch'\n").frame.matrices;
  EXPECT_LT((MatrixXd(frame.C) - MatrixXd(known.C)).cwiseAbs().maxCoeff(), 1e-12 * MatrixXd(known.C).maxCoeff());
}

/// B = b b^T on the displacements of all nodes, of one damper; its rounded entries have negative eigenvalues.
MatrixXd one_damper()
{
  Eigen::VectorXd b(24);
  for (int i = 0; i < 24; ++i)
    b[i] = std::sin(1. + 3. * i) + 1.3;
  return b * b.transpose();
}

MatrixXd rounded_to(const MatrixXd &A, int digits)
{
  return A.unaryExpr([digits](double x) { return std::stod(rounded(x, digits)); });
}

TEST_F(ImportedFrame, TakesDampersThatTheirDigitsMakeSlightlyIndefinite)
{
  const auto with = [&](const MatrixXd &B, tests::CardFields fields)
  {
    return Import{"",
                  {{"a.pch", cards(held, tests::CardFields::free_) + tests::dmig_text("BAAX", B, held.rows, fields)}},
                  on_cards + "damping = 'a.pch'\n",
                  0.};
  };
  const auto lowest = [](const MatrixXd &B)
  {
    const Eigen::VectorXd scale = B.diagonal().cwiseSqrt().cwiseInverse();
    return Eigen::SelfAdjointEigenSolver<MatrixXd>(scale.asDiagonal() * B * scale.asDiagonal()).eigenvalues()[0];
  };
  const MatrixXd nine = rounded_to(one_damper(), 9), five = rounded_to(one_damper(), 5);
  ASSERT_LT(lowest(nine), -1e-9) << "more than 1e-9, so that the number of rows must count";
  EXPECT_TRUE(read(with(nine, tests::CardFields::free_)).warnings.empty());
  ASSERT_LT(lowest(five), -1e-6);
  EXPECT_TRUE(read(with(five, tests::CardFields::free_)).warnings.empty());
  EXPECT_NO_THROW(read(with(one_damper(), tests::CardFields::small_)));
  // Sixteen digits of what had five before: nothing explains them, and it may be no error.
  MatrixXd doubtful = one_damper();
  doubtful(0, 1) = doubtful(1, 0) = doubtful(0, 1) * (1. + 1e-6);
  ASSERT_LT(lowest(doubtful), -2e-8);
  const auto scene = read(with(doubtful, tests::CardFields::free_));
  ASSERT_EQ(scene.warnings.size(), 1u);
  expect(scene.warnings[0], {"damping", "slightly negative energy", "fewer digits"});
  MatrixXd wrong = one_damper();
  wrong(0, 1) = wrong(1, 0) = wrong(0, 1) * 1.01;
  const auto said           = tests::refusal([&] { read(with(wrong, tests::CardFields::free_)); });
  expect(said, {"damping: is not positive semidefinite", "negative energy"});
}

TEST_F(ImportedFrame, ReducedToNodesAndModesKeepsItsModesAndItsWeight)
{
  const auto  reduced = tests::craig_bampton_frame(loose, 6);
  const auto  scene   = read({"", {{"a.pch", cards(reduced, tests::CardFields::free_)}}, on_cards, 0.});
  const auto &frame   = scene.frame.matrices;
  EXPECT_LT(largest_ratio(frequencies(scene), frequencies(reduced.C, reduced.M)), 1e-12);
  EXPECT_NEAR(frame.mass, loose.mass, 1e-9 * loose.mass) << "by R, whose modes follow without strain";
  EXPECT_LT((MatrixXd(frame.C) * frame.rigid_motions).cwiseAbs().maxCoeff(), 1e-9 * MatrixXd(frame.C).maxCoeff());
  EXPECT_TRUE(scene.warnings.empty()) << scene.warnings[0];
  const auto rough = read({"", {{"a.pch", cards(reduced, tests::CardFields::small_)}}, on_cards, 0.});
  EXPECT_NEAR(rough.frame.matrices.mass, loose.mass, 1e-3 * loose.mass) << "four digits";
  EXPECT_TRUE(rough.warnings.empty()) << rough.warnings[0];
  const auto again = read(on_cards, "[frame.interface.top]\nnode = 12\n[frame.interface.foot]\nnode = 11\n"
                                    "[reduction]\nmethod = 'craig-bampton'\nmodes = 3\n");
  EXPECT_TRUE(again.reduction.reduces());
}

TEST_F(ImportedFrame, TellsMassCentreAndWhatRigidMotionsLeave)
{
  const auto      scene = read({"", {{"a.pch", cards(loose)}}, on_cards, 0.});
  Eigen::Vector3d centre(0., 0., 0.);
  for (int a = 0; a < 4; ++a)
    centre += (20. + 10. * a) * Eigen::Vector3d(loose.nodes[a].second.data()) / loose.mass;
  const auto &frame = scene.frame.matrices;
  ASSERT_EQ(frame.statements.size(), 1u);
  expect(frame.statements[0], {"mass 140 kg", "centre [0.4571, 0.3857, 0.6214] m", "free"});
  for (int d = 0; d < 3; ++d)
    EXPECT_NEAR(frame.centre[d], centre[d], 1e-8);
  EXPECT_LT((MatrixXd(frame.C) * frame.rigid_motions).cwiseAbs().maxCoeff(), 1e-8 * MatrixXd(frame.C).maxCoeff());
}

TEST_F(ImportedFrame, WarnsOfPlacesThatBelongToOtherRows)
{
  const auto warning = [&](const tests::LumpedFrame &frame, const std::string &more)
  {
    const auto scene = read({"", {{"a.pch", cards(frame, tests::CardFields::free_)}}, on_cards, 0.}, more);
    return scene.warnings.empty() ? std::string("no warning") : scene.warnings[0];
  };
  EXPECT_EQ(warning(loose, ""), "no warning");
  auto exchanged = loose;
  std::swap(exchanged.nodes[0].first, exchanged.nodes[3].first);
  expect(warning(exchanged, ""), {"places of nodes do not fit the stiffness", "rows without support", "the worst"});
  auto in_millimetres = loose;
  for (auto &[number, x] : in_millimetres.nodes)
    for (double &coordinate : x)
      coordinate *= 1e3;
  expect(warning(in_millimetres, ""), {"in another unit"});
  auto other_directions = loose; // ux and rx of a node exchanged
  std::swap(other_directions.rows[0].second, other_directions.rows[3].second);
  expect(warning(other_directions, ""), {"leaves 6 motions free", "other nodes or directions"});
  auto other_mass    = loose;
  other_mass.M(0, 0) = 60.;
  expect(warning(other_mass, ""), {"the frame is free, but weighs 180, 140 and 140 kg"});
}

TEST_F(ImportedFrame, TakesInterfacesByNumberPlaceOrName)
{
  Import import              = imports(held).back();
  import.files.back().second = tests::node_table_text(held, "m", true);
  const auto named           = read(import, "", "");
  ASSERT_EQ(named.frame.matrices.interfaces.size(), 4u);
  EXPECT_EQ(named.frame.matrices.interfaces[0].name, "n7") << "in the order of their numbers";
  const auto by_place = read(imports(held)[0], "", "[frame.interface.top]\nposition = ['1.2 m', '100 mm', 0]\n");
  EXPECT_EQ(by_place.frame.matrices.interfaces[0].coordinate[0], 6 + 6) << "rows are in the order of nodes";
  refused(on_cards, {"position", "nearest is 11", "m away"}, "[frame.interface.top]\nposition = [0, 0.2, 0]\n");
  refused(on_cards, {"node 99 has no row"}, "[frame.interface.top]\nnode = 99\n");
  refused(on_cards, {"node 12 is at [1.2, 0.1, 0] m"}, "[frame.interface.top]\nnode = 12\nposition = [0, 0, 0]\n");
  refused(on_cards, {"leave one of 'node' and 'rows' out"}, "[frame.interface.top]\nnode = 12\nrows = { ux = 1 }\n");
  refused(on_cards, {"needs node ="}, "[frame.interface.top]\n");
  refused(on_cards, {"row 13 is a.ux already"}, "[frame.interface.a]\nnode = 12\n[frame.interface.b]\nnode = 12\n");
  refused(on_cards, {"has no interface", "node ="}, "");
  refused("mass = [[1]]\nstiffness = [[1]]\n", {"tell the nodes of their rows"});
}

TEST_F(ImportedFrame, WithoutPlacesOfNodesIsTakenAtThePositionsGiven)
{
  folder.write("a.pch", tests::dmig_text("KAAX", held.C, held.rows, tests::CardFields::large) +
                            tests::dmig_text("MAAX", held.M, held.rows, tests::CardFields::large));
  const auto scene = read(on_cards, "[frame.interface.top]\nnode = 12\nposition = ['1.2 m', 0, 0]\n");
  EXPECT_EQ(scene.frame.matrices.interfaces[0].position[0], 1.2);
  EXPECT_TRUE(scene.frame.matrices.picture.points.empty());
  EXPECT_NEAR(scene.frame.matrices.mass, held.mass, 1e-8) << "translations need no places";
  refused(on_cards, {"places of nodes are known"}, "[frame.interface.top]\nposition = [0, 0, 0]\n");
}

TEST_F(ImportedFrame, DampingIsThatOfTheFileWhereItIsAskedFor)
{
  const MatrixXd    B = 1e-4 * held.C;
  const std::string damped =
      cards(held, tests::CardFields::free_) + tests::dmig_text("BAAX", B, held.rows, tests::CardFields::free_);
  folder.write("a.pch", damped);
  const auto &units = "file_units = { time = '1 ms' }\n"; // force in kg m / ms^2, and damping with it
  const auto  taken = read(on_cards + "damping = 'a.pch'\n" + units).frame.matrices;
  EXPECT_LT((MatrixXd(taken.B) - 1e-4 * 1e-3 * MatrixXd(taken.C)).cwiseAbs().maxCoeff(), 1e-6);
  const auto left = read(on_cards);
  ASSERT_EQ(left.warnings.size(), 1u);
  expect(left.warnings[0], {"BAAX", "left out", "damping ="});
  EXPECT_TRUE(read(on_cards + "damping = { ratio = 0.01 }\n").warnings.empty());
  folder.write("a.pch", cards(held) + "DMIG,BAAX,0,6,2\n");
  EXPECT_TRUE(read(on_cards).warnings.empty()) << "an empty matrix is no damping";
  folder.write("a.pch", cards(held) + tests::dmig_text("K4AAX", B, held.rows, tests::CardFields::free_));
  expect(read(on_cards).warnings.at(0), {"K4AAX", "structural damping", "half the loss factor"});
}

TEST_F(ImportedFrame, RefusesFilesThatDoNotBelongTogether)
{
  folder.write("a.pch", tests::grid_text(held) + tests::dmig_text("KAAX", held.C, held.rows, tests::CardFields::large));
  refused(on_cards, {"mass", "no matrix MAAX", "KAAX", "matrix_names"});
  folder.write("K", tests::harwell_boeing_text(held.C, true));
  folder.write("M", tests::harwell_boeing_text(held.M, true));
  folder.write("M.pch", tests::dmig_text("MAAX", held.M, held.rows, tests::CardFields::large));
  folder.write("a.dof", tests::dof_text(held.rows));
  folder.write("short.dof", tests::dof_text({held.rows.begin(), held.rows.end() - 1}));
  const std::string both = "mass = 'M'\nstiffness = 'K'\n";
  refused(both + "rows = 'short.dof'\n", {"names 23 rows", "24 x 24"});
  refused("mass = 'M.pch'\nstiffness = 'K'\n", {"does not tell what its rows are"});
  refused(both + "file_units = { length = '1 mm' }\n", {"displacements", "rows ="},
          "[frame.interface.top]\nrows = { ux = 1 }\n");
  refused(both + "rows = 'a.dof'\nfile_units = { length = '-1 mm' }\n", {"length"});
  auto elsewhere = held.rows;
  for (auto &[node, direction] : elsewhere)
    node += 100;
  folder.write("M.pch", tests::dmig_text("MAAX", held.M, elsewhere, tests::CardFields::large));
  refused("mass = 'M.pch'\nstiffness = 'a.pch'\n", {"no row in common", "node 107, ux"});
  elsewhere          = held.rows;
  elsewhere[0].first = 99;
  folder.write("M.pch", tests::grid_text(held) + "GRID,99,,0.,0.,0.\n" +
                            tests::dmig_text("MAAX", held.M, elsewhere, tests::CardFields::large));
  const auto scene = read("mass = 'M.pch'\nstiffness = 'a.pch'\nnodes = 'M.pch'\n");
  expect(scene.warnings.at(0), {"1 row of it are not in the stiffness", "node 99, ux"});
  expect(scene.frame.matrices.statements.at(0), {"mass: 1 row of the stiffness have none", "node 11, ux"});
  folder.write("nodes.csv", "node,x,y,z\n11,0,0,0\n12,1,0,0\n");
  refused(both + "rows = 'a.dof'\nnodes = 'nodes.csv'\n", {"no place of node 7 and 1 more of 4"});
  folder.write("nodes.csv", "node,x,y,z,ux\n11,0,0,0,1\n");
  refused(both + "rows = 'a.dof'\nnodes = 'nodes.csv'\n", {"both 'node' and 'ux'"});
  folder.write("nodes.csv", "x,y,z\n0,0,0\n");
  refused(both + "rows = 'a.dof'\nnodes = 'nodes.csv'\n", {"no column 'node'"});
  folder.write("nodes.csv", "name,node,x,y,z\na,99,0,0,0\n");
  refused(both + "rows = 'a.dof'\nnodes = 'nodes.csv'\n", {"node 99 ('a') has no row"});
}

TEST_F(ImportedFrame, RefusesMatricesNoFrameHasByNodeAndDirection)
{
  folder.write("a.dof", tests::dof_text(held.rows));
  const auto with = [&](const std::string &file, MatrixXd A, int i, int j, double value)
  {
    A(i, j) = value;
    folder.write("K", tests::matrix_market_text(held.C));
    folder.write("M", tests::matrix_market_text(held.M));
    folder.write(file, tests::matrix_market_text(A));
    return tests::refusal([&] { read("mass = 'M'\nstiffness = 'K'\nrows = 'a.dof'\n"); });
  };
  expect(with("K", held.C, 7, 2, 1.), {"stiffness: is not symmetric", "row 3, column 8 (node 11, uz; node 12, uy)"});
  expect(with("M", held.M, 7, 7, -1.), {"mass: is not positive semidefinite: row 8 (node 12, uy) has -1"});
  expect(with("K", held.C, 7, 7, -1.), {"stiffness: is not positive semidefinite: row 8 (node 12, uy)"});
  expect(with("M", held.M, 7, 8, 1e9), {"mass", "one triangle"});
}

} // namespace

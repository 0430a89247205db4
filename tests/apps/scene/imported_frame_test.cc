// The same frame through every format of other programs has the same matrices, frequencies and motion as through
// MatrixMarket, to the digits of the format; units, nodes, and what is told of pairings that are wrong.

#include "coupling/simulation/simulation.h"
#include "fem/values/number_text.h"
#include "tests/apps/scene/imported_frame.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
      refused(on_cards + nodes, {"nodes", "node 12 has another displacement coordinate system in", "a.pch"});
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
  refused(on_cards, {"node 12 has its own displacement coordinate system", "node 12, uy has no row"});
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
  expect(warning(exchanged, ""),
         {"positions of nodes do not match the stiffness", "rows without support", "the worst"});
  auto in_millimetres = loose;
  for (auto &[number, x] : in_millimetres.nodes)
    for (double &coordinate : x)
      coordinate *= 1e3;
  expect(warning(in_millimetres, ""), {"of another model, unit or order"});
  auto other_directions = loose; // ux and rx of a node exchanged
  std::swap(other_directions.rows[0].second, other_directions.rows[3].second);
  expect(warning(other_directions, ""), {"has 6 unconstrained motions", "other nodes or directions"});
  auto other_mass    = loose;
  other_mass.M(0, 0) = 60.;
  expect(warning(other_mass, ""), {"the frame is free, but its mass is 180, 140 and 140 kg"});
}

} // namespace

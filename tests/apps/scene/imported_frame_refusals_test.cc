// Frames of other programs: what names their interfaces, what is taken besides, what is refused and how.

#include "tests/apps/scene/imported_frame.h"

namespace
{

using namespace gestell;
using Eigen::MatrixXd;

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
  refused(on_cards, {"remove 'node' or 'rows'"}, "[frame.interface.top]\nnode = 12\nrows = { ux = 1 }\n");
  refused(on_cards, {"needs node ="}, "[frame.interface.top]\n");
  refused(on_cards, {"row 13 is a.ux already"}, "[frame.interface.a]\nnode = 12\n[frame.interface.b]\nnode = 12\n");
  refused(on_cards, {"has no interface", "node ="}, "");
  refused("mass = [[1]]\nstiffness = [[1]]\n", {"define the nodes of their rows"});
}

TEST_F(ImportedFrame, WithoutPlacesOfNodesIsTakenAtThePositionsGiven)
{
  folder.write("a.pch", tests::dmig_text("KAAX", held.C, held.rows, tests::CardFields::large) +
                            tests::dmig_text("MAAX", held.M, held.rows, tests::CardFields::large));
  const auto scene = read(on_cards, "[frame.interface.top]\nnode = 12\nposition = ['1.2 m', 0, 0]\n");
  EXPECT_EQ(scene.frame.matrices.interfaces[0].position[0], 1.2);
  EXPECT_TRUE(scene.frame.matrices.picture.points.empty());
  EXPECT_NEAR(scene.frame.matrices.mass, held.mass, 1e-8) << "translations need no places";
  refused(on_cards, {"needs the positions of nodes"}, "[frame.interface.top]\nposition = [0, 0, 0]\n");
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
  expect(left.warnings[0], {"BAAX", "ignored", "damping ="});
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
  refused("mass = 'M.pch'\nstiffness = 'K'\n", {"identifies its rows in a different way"});
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
  refused(both + "rows = 'a.dof'\nnodes = 'nodes.csv'\n",
          {"no position for 2 of the 4 nodes in the matrices, such as node 7"});
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

// A reduced frame written for other programs and taken back as a frame given by matrices.

#include "apps/cli/export_frame.h"
#include "apps/scene/build/build_machine.h"
#include "coupling/reduction/dense_frame.h"
#include "tests/support/cached_frame.h"
#include "tests/support/program.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell;

std::string text_of_file(const std::string &name)
{
  std::ifstream in(name);
  return {std::istreambuf_iterator<char>(in), {}};
}

coupling::ReducedFrame frame_with_picture()
{
  auto frame                        = test::chain_frame();
  frame.outputs[0].name             = "support.foot.z";
  frame.outputs[0].on_v             = Eigen::Vector3d(1., -2. / 3., 3.);
  frame.outputs[0].on_a             = Eigen::Vector3d(-1. / 7., 5., 0.1);
  frame.interfaces[0].position      = {0.1, 1. / 3., 2.};
  frame.interfaces[0].sign[fem::uz] = -1.;
  frame.points                      = {{0., 0., 0.}, {1., 0., 0.}, {0., 1. / 7., 0.}};
  frame.triangles                   = {{0, 1, 2}};
  frame.displacement                = Eigen::MatrixXf::Random(9, 3);
  return frame;
}

/// Force of an output at coordinates p, velocities v, accelerations a and gravity g.
double force(const fem::FrameOutput &output, const Eigen::Vector3d &p, const Eigen::Vector3d &v,
             const Eigen::Vector3d &a, const Eigen::Vector3d &g)
{
  return output.on_q.dot(p) + output.on_v.dot(v) + output.on_a.dot(a) + output.under_acceleration.dot(g);
}

using MatrixExport = ::testing::TestWithParam<const char *>;

TEST_P(MatrixExport, ComesBackAsTheSameFrame)
{
  const test::SceneFolder folder;
  const auto              frame = frame_with_picture();
  apps::export_frame(folder.path(""), frame, apps::matrix_format(GetParam()), "a test");
  const auto scene = apps::read_scene(folder.write("back.toml", text_of_file(folder.path("frame.toml"))));
  const auto back  = coupling::dense_frame(scene.frame.matrices);

  const auto same = [](const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
  { return (a - b).cwiseAbs().maxCoeff() <= 1e-15 * b.cwiseAbs().maxCoeff(); };
  EXPECT_TRUE(same(back.M, frame.M));
  EXPECT_TRUE(same(back.B, frame.B));
  EXPECT_TRUE(same(back.C, frame.C));
  EXPECT_TRUE(back.modal);
  EXPECT_EQ(back.n_interface, 1);
  EXPECT_TRUE(same(back.omega0, frame.omega0));
  ASSERT_EQ(back.interfaces.size(), 1u);
  EXPECT_EQ(back.interfaces[0].name, "top");
  EXPECT_EQ(back.interfaces[0].coordinate, frame.interfaces[0].coordinate);
  EXPECT_EQ(back.interfaces[0].sign[fem::uz], -1.);
  EXPECT_EQ(back.interfaces[0].position, frame.interfaces[0].position);
  ASSERT_EQ(back.outputs.size(), 1u);
  EXPECT_EQ(back.outputs[0].name, "support.foot.z");
  EXPECT_TRUE(same(back.outputs[0].on_q, frame.outputs[0].on_q));
  EXPECT_TRUE(same(back.outputs[0].on_v, frame.outputs[0].on_v));
  ASSERT_EQ(back.outputs[0].on_a.size(), 3);
  EXPECT_TRUE(same(back.outputs[0].on_a, frame.outputs[0].on_a));
  EXPECT_TRUE(same(back.outputs[0].under_acceleration, frame.outputs[0].under_acceleration));
  // M M^-1 f with M of condition 1e2
  EXPECT_LT((back.translations_load - frame.translations_load).norm(), 1e-13 * frame.translations_load.norm());
  EXPECT_EQ(back.mass, frame.mass) << "clamped parts included, which M does not show";
  ASSERT_EQ(back.points.size(), 4u); // the interface comes first
  EXPECT_EQ(back.points[3], frame.points[2]);
  EXPECT_EQ(back.triangles[0], (std::array<int, 3>{1, 2, 3}));
  EXPECT_EQ(back.displacement.bottomRows(9), frame.displacement);
  EXPECT_EQ(back.displacement(2, 0), -1.F);
}

INSTANTIATE_TEST_SUITE_P(Formats, MatrixExport, ::testing::Values("matrix-market", "petsc"));

TEST(MatrixExportOnCards, ComesBackToTenDigitsWithMotionsAlongTheAxes)
{
  const test::SceneFolder folder;
  const auto              frame = frame_with_picture();
  apps::export_frame(folder.path(""), frame, apps::matrix_format("dmig"), "a test");
  const auto scene = apps::read_scene(folder.write("back.toml", text_of_file(folder.path("frame.toml"))));
  const auto back  = coupling::dense_frame(scene.frame.matrices);

  Eigen::VectorXd sign = Eigen::VectorXd::Ones(frame.M.rows());
  sign[0]              = -1.; // row 0 counts against z
  const auto same      = [&](const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
  {
    const Eigen::MatrixXd along = sign.asDiagonal() * b * sign.asDiagonal();
    return (a - along).cwiseAbs().maxCoeff() <= 5.1e-10 * b.cwiseAbs().maxCoeff();
  };
  ASSERT_EQ(frame.interfaces[0].coordinate[fem::uz], 0);
  EXPECT_TRUE(same(back.M, frame.M));
  EXPECT_TRUE(same(back.B, frame.B));
  EXPECT_TRUE(same(back.C, frame.C));
  ASSERT_EQ(back.interfaces.size(), 1u);
  EXPECT_EQ(back.interfaces[0].name, "top");
  EXPECT_EQ(back.interfaces[0].coordinate, frame.interfaces[0].coordinate);
  EXPECT_EQ(back.interfaces[0].sign[fem::uz], 1.);
  EXPECT_EQ(back.interfaces[0].position, frame.interfaces[0].position);
  EXPECT_LT((back.outputs.at(0).on_q - sign.asDiagonal() * frame.outputs[0].on_q).norm(),
            1e-15 * frame.outputs[0].on_q.norm());
  ASSERT_EQ(back.outputs[0].on_a.size(), 3);
  const Eigen::Vector3d p(1e-4, 2e-4, -3e-4), v(0.1, -0.2, 0.3), a(4., 5., -6.), g(0., 0., -9.81);
  const Eigen::Vector3d p_along = sign.asDiagonal() * p, v_along = sign.asDiagonal() * v,
                        a_along = sign.asDiagonal() * a;
  const double before           = force(frame.outputs[0], p, v, a, g);
  EXPECT_NEAR(force(back.outputs[0], p_along, v_along, a_along, g), before, 1e-13 * std::abs(before));
  EXPECT_LT((back.translations_load - sign.asDiagonal() * frame.translations_load).norm(),
            1e-8 * frame.translations_load.norm());
  EXPECT_EQ(back.mass, frame.mass);
}

TEST(MatrixExportOfRows, WithoutInertiaHasNone)
{
  const test::SceneFolder folder;
  auto                    frame = frame_with_picture();
  frame.outputs[0].on_a.resize(0);
  apps::export_frame(folder.path(""), frame, apps::matrix_format("matrix-market"), "a test");
  const std::string text = text_of_file(folder.path("frame.toml"));
  EXPECT_EQ(text.find("inertia_row"), std::string::npos);
  const auto scene = apps::read_scene(folder.write("back.toml", text));
  EXPECT_EQ(coupling::dense_frame(scene.frame.matrices).outputs.at(0).on_a.size(), 0);
}

TEST(DmigExport, OfAFrameWithoutDampingHasNoneAndComesBackWithoutAWarning)
{
  const test::SceneFolder folder;
  auto                    frame = frame_with_picture();
  frame.B.setZero();
  apps::export_frame(folder.path(""), frame, apps::matrix_format("dmig"), "a test");
  EXPECT_EQ(text_of_file(folder.path("frame.pch")).find("BAAX"), std::string::npos);
  const auto scene = apps::read_scene(folder.write("back.toml", text_of_file(folder.path("frame.toml"))));
  for (const std::string &warning : scene.warnings)
    EXPECT_EQ(warning.find("BAAX"), std::string::npos) << warning;
  EXPECT_EQ(scene.frame.matrices.B.nonZeros(), 0);
}

TEST(ImportedFrame, IsProvedByCheckAndGivesAWarningWithExitCodes)
{
  const tests::Folder folder("imported");
  const std::string   cards = "DMIG,KAAX,0,6,2\nDMIG,KAAX,1,1,,1,1,2.e6\nDMIG,KAAX,2,1,,1,1,-2.e6,,+\n,2,1,2.e6\n"
                              "DMIG,MAAX,0,6,2\nDMIG,MAAX,1,1,,1,1,40.\nDMIG,MAAX,2,1,,2,1,60.\n";
  const auto          check = [&](const std::string &grids)
  {
    folder.file("a.pch", grids + cards);
    return tests::gestell("check " + folder.file("s.toml", "[frame]\nmass = \"a.pch\"\nstiffness = \"a.pch\"\n"
                                                           "[frame.interface.top]\nnode = 2\n"));
  };
  tests::expect_answer(check("GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n"), 0,
                       {"frame: rigid motions of the nodes: mass 100 kg by x, centre [0", "free"});
  tests::expect_answer(check("GRID,1,,0.,0.,0.\nGRID,2,,1.,1.,0.\n"), 0,
                       {"warning", "positions of nodes do not match the stiffness"});
  tests::expect_answer(
      check("GRID,1,,0.,0.,0.\n"), 2,
      {"s.toml:3: frame.stiffness", "no position for 1 of the 2 nodes in the matrices, such as node 2"});
}

TEST(MatrixFormat, OfAnotherNameIsRefused)
{
  EXPECT_THROW(apps::matrix_format("nastran"), std::invalid_argument);
}

} // namespace

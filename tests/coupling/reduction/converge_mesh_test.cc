// Frequencies and compliances followed from mesh to mesh.

#include "coupling/plugin/frame/converge_mesh.h"
#include "tests/support/cad_samples.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using ::testing::AllOf;
using ::testing::HasSubstr;

/// A slender block, clamped below, with a node above.
fem::FrameSpecification block()
{
  const std::string script = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.2, 0.1, 1};\n";
  auto              frame  = fem::test::specification(fem::test::write_text("block.geo", script), 0.15);
  frame.material           = {210e9, 0.3, 7850., "scene.toml:3"};
  frame.surfaces["foot"]   = fem::test::plane({0., 0., -1.}, {0., 0., 0.});
  frame.surfaces["top"]    = fem::test::plane({0., 0., 1.}, {0., 0., 1.});
  frame.supports   = {{"foot", {"foot"}, fem::SupportKind::clamped, {true, true, true}, {}, {}, "scene.toml:9"}};
  frame.interfaces = {{"top", {"top"}, fem::InterfaceCoupling::average, {}, "scene.toml:12"}};
  return frame;
}

TEST(ConvergeMesh, FollowsQuantitiesByTheirNames)
{
  const auto result = coupling::converge_mesh(block(), {}, {0.2, 12});
  ASSERT_GE(result.levels.size(), 2u);
  ASSERT_EQ(result.quantities.size(), 13u);
  for (const coupling::MeshLevel &level : result.levels)
  {
    ASSERT_EQ(level.values.size(), result.quantities.size());
    for (std::size_t j = 0; j < level.names.size(); ++j)
    {
      EXPECT_EQ(level.names[j], result.quantities[j].name);
      EXPECT_NEAR(level.values[j], result.levels.back().values[j], 0.2 * level.values[j]) << level.names[j];
    }
  }
}

TEST(ConvergeMesh, DoesNotWatchTheComplianceOfPointsWhichHasNoLimit)
{
  auto frame             = block();
  frame.surfaces["side"] = fem::test::plane({1., 0., 0.}, {0.2, 0., 0.});
  frame.interfaces.push_back({"corner", {}, fem::InterfaceCoupling::node, fem::Vector3{0., 0., 0.5}, "scene.toml:15"});
  frame.interfaces.push_back(
      {"spot", {"side"}, fem::InterfaceCoupling::point, fem::Vector3{0.2, 0.05, 0.5}, "scene.toml:18"});
  const auto result = coupling::converge_mesh(frame, {}, {0.2, 2});
  EXPECT_TRUE(result.converged) << result.stopped;
  EXPECT_EQ(result.at_points, (std::vector<std::string>{"corner", "spot"}));
  ASSERT_EQ(result.quantities.size(), 3u);
  EXPECT_EQ(result.quantities[2].name, "compliance of top");
}

TEST(ConvergeMesh, RefinesDistinctlyAndStatesLimitsOnTheirSideTellingEachMeshAsItIsMade)
{
  coupling::ConvergenceOptions options;
  options.tolerance  = 1e-4; // not to be met
  options.max_meshes = 4;
  std::vector<std::size_t> told;
  options.after_mesh = [&](const coupling::MeshConvergence &so_far)
  {
    EXPECT_EQ(so_far.quantities.size(), so_far.levels.back().values.size());
    told.push_back(so_far.levels.size());
  };
  const auto result = coupling::converge_mesh(block(), {}, options);
  ASSERT_EQ(result.levels.size(), 4u);
  EXPECT_EQ(told, (std::vector<std::size_t>{1, 2, 3, 4}));
  for (std::size_t i = 1; i < result.levels.size(); ++i)
    EXPECT_GE(result.levels[i].n_coordinates, 1.5 * result.levels[i - 1].n_coordinates);
  for (std::size_t j = 0; j < result.quantities.size(); ++j)
    for (const coupling::MeshLevel &level : result.levels)
      if (result.quantities[j].unit == "Hz")
        EXPECT_LE(result.quantities[j].limit, level.values[j] * (1. + 1e-9)) << result.quantities[j].name;
      else
        EXPECT_GE(result.quantities[j].limit, level.values[j] * (1. - 1e-9)) << result.quantities[j].name;
  EXPECT_FALSE(result.converged);
  EXPECT_THAT(result.stopped, AllOf(HasSubstr("4 meshes is the limit; "), HasSubstr(" would need about ")));
}

TEST(ConvergeMesh, MakesNoMeshThatTheMemoryDoesNotHold)
{
  coupling::ConvergenceOptions options;
  options.tolerance = 1e-4;                         // not to be met
  options.memory    = 0.25 * 1024. * 1024. * 1024.; // 0.22 GiB are taken by the libraries
  const auto result = coupling::converge_mesh(block(), {}, options);
  EXPECT_FALSE(result.converged);
  EXPECT_THAT(result.stopped, HasSubstr("that the available memory of 0.25 GiB allows"));
  EXPECT_LT(result.levels.back().n_coordinates, 20000); // 0.37 GiB for 100 000
}

/// block() by a script that meshes by itself.
fem::FrameSpecification block_by_script(const std::string &mesh)
{
  auto frame = block();
  frame.cad  = fem::test::write_text("meshed.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.2, 0.1, 1};\n" +
                                                       mesh + "Mesh 3;\n");
  return frame;
}

TEST(ConvergeMesh, RefinesAScriptThatMeshesByItselfAsAWhole)
{
  const auto result = coupling::converge_mesh(block_by_script(""), {}, {0.05});
  ASSERT_GE(result.levels.size(), 2u) << result.stopped;
  EXPECT_TRUE(result.converged) << result.stopped;
  for (std::size_t i = 1; i < result.levels.size(); ++i)
  {
    EXPECT_LT(result.levels[i].size, result.levels[i - 1].size);
    EXPECT_GE(result.levels[i].n_coordinates, 1.2 * result.levels[i - 1].n_coordinates);
  }
}

TEST(ConvergeMesh, IsNotProvedByAMeshThatStaysAsItIs)
{
  // a third of the nodes is held: they are no coordinates, and no finer mesh
  const auto result = coupling::converge_mesh(
      block_by_script("Transfinite Curve {:} = 3;\nTransfinite Surface {:};\nTransfinite Volume {:};\n"), {}, {0.9});
  EXPECT_EQ(result.levels.size(), 1u);
  EXPECT_FALSE(result.converged);
  EXPECT_THAT(result.stopped, HasSubstr("gmsh cannot make a mesh with clearly more than"));
  EXPECT_THAT(result.stopped, ::testing::Not(HasSubstr("would need")));
}

TEST(ConvergeMesh, OfMoreFrequenciesThanTheFirstMeshHasIsRefused)
{
  coupling::ReductionOptions reduction;
  reduction.n_modes = 4;
  coupling::ConvergenceOptions options;
  options.n_frequencies = 20;
  for (const std::string method : {"craig-bampton", "free-interface"})
  {
    reduction.method          = method;
    const std::string known   = method == "craig-bampton" ? "10" : "4"; // n1 + m, or m
    const std::string message = tests::refusal([&] { coupling::converge_mesh(block(), reduction, options); });
    EXPECT_THAT(message, AllOf(HasSubstr("20 frequencies"), HasSubstr("has " + known + " elastic modes"),
                               HasSubstr("--frequencies " + known), HasSubstr("modes")));
  }
}

} // namespace
} // namespace gestell::test

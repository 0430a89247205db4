// Error budgets of frames from CAD against a mesh that is far finer.

#include "apps/session/session.h"
#include "apps/sizing/error_budget.h"
#include "apps/sizing/size_search.h"
#include "tests/support/frame_folder.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace apps;

/// With a cache of its own: what frames cost that are there already is no measure.
class FrameSize : public test::FrameFolder
{
};

/// A bar with an eye, 50 mm thick and 50 mm wide around a hole of 200 mm, which carries a mass on a spring: of a hole
/// with few sides the eye is too thick where it bends.
Scene eye_bar(test::SceneFolder &folder, const std::string &mesh)
{
  folder.write("eye.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.3, 0.05, 0.3};\n"
                          "Cylinder(2) = {0.15, -1, 0.15, 0, 2, 0, 0.1};\n"
                          "BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };\n");
  const std::string text =
      "name = 'eye'\n[frame]\ncad = 'eye.geo'\nunit = '1 m'\nmesh = { " + mesh + " }\ndamping = { ratio = 0.02 }\n" +
      plane_surface("foot", "[0, 0, -1]", "[0, 0, 0]") + plane_surface("top", "[0, 0, 1]", "[0, 0, 0.3]") +
      table("frame.support.foot", {{"surface", "foot"}, {"clamped", "true"}}) +
      table("frame.interface.top", {{"surface", "top"}, {"coupling", "average"}}) +
      table("reduction", {{"modes", "12"}}) + slider_body("load", "5 kg", "[0, 0, 1]", {{"guide", "frame.top"}}) +
      element("spring", "spring-damper",
              {{"from", "load"}, {"to", "frame.top"}, {"stiffness", "60 kN/mm"}, {"damping", "50 N s/m"}}) +
      element("blow", "force",
              {{"from", "frame.top"},
               {"to", "ground"},
               {"direction", "[1, 0, 0]"},
               {"harmonics", "[{ amplitude = '1 kN', frequency = '400 Hz' }]"}}) +
      "[modes]\nnumber = 4\n[run]\nmethod = 'exact'\ntolerance = 1e-6\nend = '10 ms'\n" + signals("x = 'frame.top.ux'");
  return read_scene(folder.write("scene.toml", test::quoted(text)));
}

/// The polygon of the hole is most of the error: elements of degree three alone see a third of it.
TEST(FrameBudget, OfCoarseCellsAroundAHoleIsAtLeastHalfOfTheTrueError)
{
  test::SceneFolder rough_folder, fine_folder;
  const Scene       rough   = eye_bar(rough_folder, "size = '60 mm'");
  const Scene       fine    = eye_bar(fine_folder, "size = '20 mm', curved = true");
  const auto        outputs = budget_outputs(rough, "x.max,modes.1,modes.2,modes.3");
  const ErrorBudget budget  = error_budget(rough, outputs, answer_of(rough, {}, outputs));
  const ModelAnswer truth   = answer_of(fine, {}, outputs);
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    const BudgetEntry &entry = budget.entries[i];
    ASSERT_TRUE(entry.total) << entry.output;
    const double error = std::abs(entry.value - truth.values[i]);
    EXPECT_GT(error, 3e-4 * std::abs(entry.value)) << entry.output << ": the test needs a coarse mesh";
    EXPECT_GE(*entry.total, 0.5 * error) << entry.output << ", " << entry.mesh.reason;
    EXPECT_LE(*entry.total, 4. * error) << entry.output;
  }
}

/// Stresses at ten places of a bar in bending, torsion and tension, with six modes: what the budget prints is at least
/// the difference to the direct integration of all coordinates with the same steps, at every instant.
TEST(FrameBudget, OfStressHistoriesHoldsAgainstTheFullFrame)
{
  test::SceneFolder folder;
  folder.write("bar.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, -0.1, -0.125, 2, 0.2, 0.25};\n");
  std::string text = "name = 'bar'\n[frame]\ncad = 'bar.geo'\nunit = '1 m'\nmesh = { size = '120 mm' }\n"
                     "damping = { ratio = 0.02 }\n" +
                     plane_surface("wall", "[-1, 0, 0]", "[0, 0, 0]") + plane_surface("tip", "[1, 0, 0]", "[2, 0, 0]") +
                     table("frame.support.wall", {{"surface", "wall"}, {"clamped", "true"}}) +
                     table("frame.interface.tip", {{"surface", "tip"}, {"coupling", "average"}}) +
                     table("reduction", {{"modes", "6"}});
  constexpr int places = 10;
  std::string   wanted, list;
  for (int i = 0; i < places; ++i)
  {
    const std::string name = "s" + std::to_string(i), x = number(0.3 + 0.15 * i);
    text += table("frame.stress_point." + name,
                  {{"at", i % 2 == 0 ? "[" + x + ", 0.03, 0.125]" : "[" + x + ", 0.1, 0.04]"}});
    wanted += (i > 0 ? "\n" : "") + name + " = 'frame.stress." + name + ".xx'";
    list += (i > 0 ? "," : "") + name + ".max," + name + ".min";
  }
  for (const auto &[axis, frequency] :
       {std::pair("[0, 0, 1]", "130 Hz"), std::pair("[0, 1, 0]", "170 Hz"), std::pair("[1, 0, 0]", "310 Hz")})
    text += element("load" + std::string(frequency, 3), "force",
                    {{"from", "frame.tip"},
                     {"to", "ground"},
                     {"direction", axis},
                     {"harmonics", "[{ amplitude = '10 kN', frequency = '" + std::string(frequency) + "' }]"}});
  text += steps("20 us", "20 ms") + "[output.signals]\n" + wanted + "\n";
  std::string full_text = test::quoted(text);
  full_text.replace(full_text.find("modes = 6"), 9, "method = \"none\"");
  const std::string file    = folder.write("scene.toml", test::quoted(text));
  const Scene       scene   = read_scene(file);
  const auto        outputs = budget_outputs(scene, list);
  const ErrorBudget budget  = error_budget(scene, outputs, answer_of(scene, {}, outputs));
  Session           small(file), whole(folder.write("full.toml", full_text));
  const auto        reduced = small.run().run, full = whole.run().run;
  const std::size_t width = full->columns.size(), n = full->rows.size();
  ASSERT_GT(whole.machine().machine.size(), 50 * small.machine().machine.size());
  ASSERT_EQ(reduced->rows.size(), n);
  for (std::size_t i = 0; i < places; ++i)
  {
    double difference = 0.;
    for (std::size_t at = i + 1; at < n; at += width)
      difference = std::max(difference, std::abs(full->rows[at] - reduced->rows[at]));
    for (const std::size_t entry : {2 * i, 2 * i + 1})
    {
      const BudgetEntry &printed = budget.entries[entry];
      EXPECT_LE(difference, *printed.reduction.error) << printed.output;
      EXPECT_LE(*printed.reduction.error, 3. * difference) << printed.output;
    }
  }
}

/// Nothing is known of what straight sides of hexahedra leave of a hole, and of a plate without one there is nothing.
TEST(FrameBudget, OfSweptPlatesIsKnownWhereAllFacesArePlanes)
{
  for (const bool has_hole : {true, false})
  {
    test::SceneFolder folder;
    Scene             scene = eye_bar(folder, "size = '60 mm', plates = 'swept'");
    if (!has_hole)
      folder.write("eye.geo", "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 0.3, 0.05, 0.3};\n");
    const auto         outputs = budget_outputs(scene, "modes.1");
    const ErrorBudget  budget  = error_budget(scene, outputs, answer_of(scene, {}, outputs));
    const BudgetEntry &entry   = budget.entries.at(0);
    EXPECT_EQ(entry.mesh.error.has_value(), !has_hole) << entry.mesh.reason;
    EXPECT_EQ(entry.total.has_value(), !has_hole);
    EXPECT_EQ(entry.mesh.reason.find("straight edges at curved faces") != std::string::npos, has_hole)
        << entry.mesh.reason;
  }
}

/// Tetrahedra with curved sides need fewer coordinates than straight ones, which leave more of the hole than is allowed
/// at any size; what they answer is within the tolerance of a far finer mesh, and less than twice what is printed.
TEST_F(FrameSize, IsTheSmallestOfAllKindsOfMeshForAtMostTenRuns)
{
  test::SceneFolder folder, fine_folder;
  const Scene       scene   = eye_bar(folder, "size = '40 mm'");
  const auto        outputs = budget_outputs(scene, "x.max,modes.1,modes.2");
  SizeOptions       options;
  options.tolerance      = 0.01;
  double reported        = 0.;
  options.on_forecast    = [&](const SizeForecast &forecast) { reported = forecast.cpu_s; };
  const SizedModel model = size_search(scene, outputs, options);
  ASSERT_TRUE(model.result.met) << model.result.stopped;
  EXPECT_LE(model.result.runs(), 10.);
  EXPECT_GT(reported, 0.);
  EXPECT_EQ(reported, model.result.forecast.cpu_s);
  const SizeRung &chosen = model.result.ladder.at(model.result.chosen);
  EXPECT_EQ(chosen.cells, "curved");
  const ModelAnswer truth =
      answer_of(eye_bar(fine_folder, "size = '15 mm', curved = true"), {1., 48, finest_method(scene)}, outputs);
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    const BudgetEntry &entry = chosen.entries.at(i);
    const double       error = std::abs(entry.value - truth.values.at(i));
    EXPECT_LE(error, options.tolerance * truth.sizes[i]) << entry.output;
    ASSERT_TRUE(entry.total) << entry.output;
    EXPECT_GE(*entry.total, 0.5 * error) << entry.output;
  }
}

/// Walls of 3 mm take fewer coordinates in hexahedra than in tetrahedra, and the search finds that by itself.
TEST_F(FrameSize, SweepsPlatesThatAreThin)
{
  test::SceneFolder folder;
  Scene             scene = eye_bar(folder, "size = '60 mm'");
  folder.write("eye.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.3, 0.003, 0.3}; Box(2) = {0, 0, 0, 0.3, 0.1, 0.003}; Box(3) = {0, 0.003, 0.297, 0.3, 0.1, 0.003};
BooleanUnion(4) = { Volume{1}; Delete; }{ Volume{2, 3}; Delete; };
)");
  SizeOptions options;
  options.tolerance      = 0.01;
  const SizedModel model = size_search(scene, budget_outputs(scene, "modes.1,modes.3"), options);
  ASSERT_TRUE(model.result.met) << model.result.stopped;
  EXPECT_EQ(model.result.ladder.at(model.result.chosen).cells, "swept");
}

/// Cells of 9/4 of 140 mm are larger than the bar.
TEST_F(FrameSize, GoesOnWithoutAMeshThatCannotBeMade)
{
  test::SceneFolder folder;
  SizeOptions       options;
  options.tolerance      = 0.3;
  const Scene      scene = eye_bar(folder, "size = '140 mm'");
  const SizedModel model = size_search(scene, budget_outputs(scene, "modes.1"), options);
  ASSERT_EQ(model.result.skipped.size(), 1u);
  EXPECT_THAT(model.result.skipped[0], ::testing::AllOf(::testing::HasSubstr("2.25 times the size"),
                                                        ::testing::HasSubstr("is larger than the model")));
  EXPECT_NEAR(model.result.ladder.front().mesh_size, 0.21, 1e-12);
}

} // namespace
} // namespace gestell::tests

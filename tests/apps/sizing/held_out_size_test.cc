// Budgets and sizes of frames that no law was fitted to, with the machines of shipped scenes, against far finer meshes.

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
class HeldOutSize : public test::FrameFolder
{
};

/// A press that coins, in a C-frame: two plates with bores and a round throat.
Scene c_press(test::SceneFolder &folder)
{
  folder.write("frame.geo", R"(SetFactory("OpenCASCADE"); Geometry.OCCAutoFix = 0;
Box(1) = {-350, -260, 0, 1650, 60, 3000}; Box(2) = {-350, 200, 0, 1650, 60, 3000};
Box(3) = {-350, -200, 800, 1000, 400, 100}; Box(4) = {1260, -200, 0, 40, 400, 3000};
Box(5) = {480, -200, 1740, 100, 400, 310}; Box(6) = {-350, -200, 2940, 1610, 400, 60};
BooleanUnion(8) = { Volume{1}; Delete; }{ Volume{2 : 6}; Delete; };
Box(20) = {-400, -300, 900, 850, 600, 800}; Cylinder(21) = {450, -300, 1300, 0, 600, 0, 400};
Cylinder(22) = {0, -300, 2560, 0, 600, 0, 120}; Cylinder(23) = {900, -300, 400, 0, 600, 0, 180};
Cylinder(24) = {900, -300, 2500, 0, 600, 0, 150};
BooleanDifference(9) = { Volume{8}; Delete; }{ Volume{20 : 24}; Delete; };
)");
  const auto bore = [](const std::string &name, const std::string &y)
  {
    return "[frame.surface.'crown bearing " + name + "']\ncylinder = { axis = [0, 1, 0], through = [0, " + y +
           ", 2.56], radius = 0.12 }\n";
  };
  return read_scene(folder.write(
      "scene.toml", "name = 'c press'\nextends = '" + shipped("press.toml") +
                        "'\nwithout = ['frame.surface.guides left', 'frame.cut.columns', 'output.signals.F_col', "
                        "'element.sheet', 'output.signals.F_u', 'output.signals.z']\n"
                        "[frame]\ncad = 'frame.geo'\nunit = '1 mm'\n"
                        "mesh = { size = '120 mm', 'crown bearing *' = '60 mm' }\n" +
                        bore("front", "-0.23") + bore("rear", "0.23") +
                        "[frame.surface.'guides right']\nfaces = 1\n[frame.surface.table]\nfaces = 'any'\n"
                        "[frame.surface.feet]\nfaces = 'any'\n[frame.interface.guides]\nsurfaces = ['guides right']\n"
                        "position = [0, 0, 1.88]\n[element.tool]\ntype = 'stop'\nfrom = 'slide'\nto = 'frame.table'\n"
                        "direction = [0, 0, -1]\ngap = 'x_T'\nstiffness = '130 kN/mm'\n"));
}

/// A portal of hollow columns and a hollow beam.
Scene portal(test::SceneFolder &folder)
{
  folder.write("frame.geo", R"(SetFactory("OpenCASCADE"); Geometry.OCCAutoFix = 0;
Box(1) = {-600, -110, 0, 160, 220, 1200}; Box(2) = {440, -110, 0, 160, 220, 1200};
Box(3) = {-440, -110, 640, 880, 220, 180}; Box(4) = {-700, -220, 0, 1400, 440, 40};
BooleanUnion(7) = { Volume{1}; Delete; }{ Volume{2 : 4}; Delete; };
Box(10) = {-575, -85, 40, 110, 170, 560}; Box(11) = {465, -85, 40, 110, 170, 560}; Box(12) = {-400, -85, 665, 800, 170, 130};
Cylinder(13) = {-520, -200, 1050, 0, 400, 0, 45}; Cylinder(14) = {400, 0, 1050, 300, 0, 0, 50};
BooleanDifference(8) = { Volume{7}; Delete; }{ Volume{10 : 14}; Delete; };
)");
  return read_scene(folder.write(
      "scene.toml", "name = 'portal'\nextends = '" + shipped("portal_slider_crank.toml") +
                        "'\n[parameters]\nx_0 = '-520 mm'\nz_0 = '1.05 m'\nl = '850 mm'\n[frame]\ncad = 'frame.geo'\n"
                        "mesh = { size = '80 mm', 'bearing' = '40 mm', 'guide' = '40 mm' }"));
}

/// The chosen model keeps the tolerance, its budget is at least half of the true error, and the search costs at most
/// ten runs of it.
void expect_sized(const Scene &scene, const std::string &list, double tolerance, double fine)
{
  const auto  outputs = budget_outputs(scene, list);
  SizeOptions options;
  options.tolerance       = tolerance;
  const SizedModel found  = size_search(scene, outputs, options);
  const SizeRung  &chosen = found.result.ladder.at(found.result.chosen);
  ASSERT_TRUE(found.result.met) << found.result.stopped;
  EXPECT_LE(found.result.runs(), 10.);
  ModelVariant finer      = found.chosen;
  finer.mesh              = fine;
  finer.modes             = 64;
  finer.cells             = Cells::curved;
  finer.method            = chosen.method == "exact" ? finest_method(scene) : finer_method(*found.chosen.method);
  const ModelAnswer truth = answer_of(scene, finer, outputs);
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    const BudgetEntry &entry = chosen.entries.at(i);
    const double       error = std::abs(entry.value - truth.values.at(i));
    ASSERT_TRUE(entry.total) << entry.output;
    EXPECT_GE(*entry.total, 0.5 * error) << entry.output;
    EXPECT_LE(error, tolerance * truth.sizes[i]) << entry.output;
  }
}

TEST_F(HeldOutSize, OfACFramePressToOnePercent)
{
  test::SceneFolder folder;
  expect_sized(c_press(folder), "F_P.max,F_P.min", 0.01, 0.4);
}

TEST_F(HeldOutSize, OfAHollowPortalToFivePercent)
{
  test::SceneFolder folder;
  expect_sized(portal(folder), "u_left.max,u_right.min,F_stop.max", 0.05, 0.4);
}

} // namespace
} // namespace gestell::tests

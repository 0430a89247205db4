// Error budgets against true errors, and the climb to the smallest model.

#include "apps/output/tables/size_table.h"
#include "apps/session/session.h"
#include "apps/sizing/reduction_comparison.h"
#include "apps/sizing/size_search.h"
#include "apps/sizing/sized_scene.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace apps;

constexpr int links = 40;

/// A rod of 40 masses that is held at one end and hits a stop with the other, driven at three of its modes.
std::string rod(const std::string &modes, const std::string &run)
{
  std::string mass, stiffness, row;
  const auto  matrix = [&](auto entry)
  {
    std::string text = "[";
    for (int i = 0; i < links; ++i)
    {
      text += i > 0 ? ",\n[" : "[";
      for (int j = 0; j < links; ++j)
        text += (j > 0 ? ", " : "") + number(entry(i, j));
      text += "]";
    }
    return text + "]\n";
  };
  const double k = 4e4 * links, m = 1. / links;
  const auto C = [&](int i, int j) { return i == j ? (i + 1 < links ? 2. : 1.) * k : std::abs(i - j) == 1 ? -k : 0.; };
  return "name = 'rod'\n[frame]\nmass = " + matrix([&](int i, int j) { return i == j ? m : 0.; }) +
         "stiffness = " + matrix(C) + "damping = " + matrix([&](int i, int j) { return 2e-6 * C(i, j); }) +
         "[frame.interface.tip]\nrows = { ux = " + std::to_string(links) + " }\n[reduction]\n" + modes +
         "\n[element.load]\ntype = 'force'\nfrom = 'frame.tip'\nto = 'ground'\ndirection = [1, 0, 0]\nharmonics = ["
         "{ amplitude = '40 N', frequency = '55 Hz' }, { amplitude = '60 N', frequency = '170 Hz' }, "
         "{ amplitude = '80 N', frequency = '250 Hz' }]\n"
         "[element.stop]\ntype = 'stop'\nfrom = 'frame.tip'\nto = 'ground'\ndirection = [1, 0, 0]\ngap = '1 mm'\n"
         "stiffness = 2e5\n[output.signals]\nx = 'frame.tip.ux'\nF = 'stop.force'\n[run]\n" +
         run;
}

struct Read
{
  test::SceneFolder folder;
  Scene             scene;
  explicit Read(const std::string &text) : scene(read_scene(folder.write("scene.toml", test::quoted(text)))) {}
};

const std::string by_steps = "method = 'bdf'\nstep = 2e-5\nend = 0.06\n";

std::vector<OutputName> of_scene(const Scene &scene, const std::string &list)
{
  return budget_outputs(scene, list);
}

ErrorBudget budget_of(const Scene &scene, const std::vector<OutputName> &outputs)
{
  return error_budget(scene, outputs, answer_of(scene, {}, outputs));
}

} // namespace

/// At least half of the true error, which the whole rod and exact steps tell, and the reduction's part at most three
/// times it; the part of the time may stand above that, as errors of the two can cancel.
TEST(ErrorBudget, IsNearTheTrueErrorOfStepsAndModes)
{
  for (const int modes : {3, 5, 8})
  {
    const Read        rough(rod("modes = " + std::to_string(modes), by_steps));
    const auto        outputs = of_scene(rough.scene, "x.max,x.min,F.max,modes.1,modes.3");
    const ErrorBudget budget  = budget_of(rough.scene, outputs);
    const Read        whole(rod("modes = " + std::to_string(links - 1), by_steps));
    const ModelAnswer truth = answer_of(whole.scene, {1., -1, finest_method(whole.scene)}, outputs);
    for (std::size_t i = 0; i < outputs.size(); ++i)
    {
      const BudgetEntry &entry = budget.entries[i];
      EXPECT_EQ(entry.output, outputs[i].text);
      EXPECT_EQ(entry.mesh.error, 0.) << entry.output;
      if (!entry.total) // another order of events
      {
        ASSERT_TRUE(entry.bracket);
        continue;
      }
      const double error = std::abs(entry.value - truth.values[i]), noise = 1e-9 * std::abs(entry.value);
      EXPECT_GE(*entry.total, 0.5 * error - noise) << entry.output << ", " << modes << " modes";
      EXPECT_LE(std::max(*entry.time.error, *entry.reduction.error), 3. * error + *entry.time.error + noise)
          << entry.output << ", " << modes << " modes";
    }
  }
}

/// Joints leave no exact method: half the step tells 3/4 of an error of second order, and the budget the whole of it.
TEST(ErrorBudget, OfStepsAloneIsTheErrorThatTheirOrderPredicts)
{
  const auto with = [](const std::string &method)
  {
    return "gravity = [0, 0, -10]\n" + planar_body("bar", "2 kg", "0.1 kg m^2", "[0, 0, '-0.5 m']") +
           revolute("pin", "ground", "bar", "[0, 0, 0]") + start("q = { 'bar.angle' = 1 }") +
           "[output.signals]\nphi = 'bar.angle'\n[run]\nend = 0.5\n" + method;
  };
  const Read steps(with("method = 'bdf'\norder = 2\nstep = 1e-3\n")),
      fine(with("method = 'bdf'\nstep = 0.05\ntolerance = 1e-11\n"));
  const auto        outputs = of_scene(steps.scene, "phi.final");
  const ErrorBudget budget  = budget_of(steps.scene, outputs);
  const double      error   = std::abs(budget.entries.at(0).value - answer_of(fine.scene, {}, outputs).values.at(0));
  EXPECT_EQ(budget.entries[0].time.reason, "against half the step");
  EXPECT_NEAR(*budget.entries[0].time.error, error, 0.03 * error) << "but for what is of third order";
}

/// Modes count against the coordinates of frame and mechanism together, also where the frame has but one.
TEST(ErrorBudget, OfASuperpositionCountsTheOmittedModes)
{
  std::string text =
      "name = 'few'\n[frame]\nmass = [[1]]\nstiffness = [[4e5]]\n[frame.interface.tip]\n"
      "rows = { ux = 1 }\n[reduction]\nmethod = 'modal'\nmodes = 2\n"
      "[element.load]\ntype = 'force'\nfrom = 'frame.tip'\nto = 'ground'\ndirection = [1, 0, 0]\n"
      "constant = '30 N'\nharmonics = [{ amplitude = '40 N', frequency = '110 Hz' }]\n[output.signals]\nx = "
      "'frame.tip.ux'\n[run]\nmethod = 'exact'\ntolerance = 1e-9\nend = 0.05\n";
  std::string before = "frame.tip";
  for (const std::string name : {"a", "b", "c"})
  {
    text += "[body." + name + "]\ntype = 'slider'\naxis = [1, 0, 0]\nmass = 1\n[element.s" + name +
            "]\ntype = 'spring-damper'\nfrom = '" + name + "'\nto = '" + before +
            "'\ndirection = [1, 0, 0]\nstiffness = 4e5\n";
    before = name;
  }
  const Read   read(text);
  const Scene &scene   = read.scene;
  const auto   outputs = budget_outputs(scene, "x.max");
  const auto   budget  = error_budget(scene, outputs, answer_of(scene, {}, outputs));
  ModelVariant whole;
  whole.modes        = 4;
  const auto   truth = answer_of(scene, whole, outputs);
  const double error = std::abs(budget.entries.at(0).value - truth.values.at(0));
  EXPECT_GT(error, 1e-3 * truth.values[0]);
  EXPECT_GE(*budget.entries[0].reduction.error, 0.5 * error);
}

TEST(ErrorBudget, HasNothingToReportOfPartsThatDoNotErr)
{
  const Read        whole(rod("method = 'none'", by_steps));
  const auto        outputs = of_scene(whole.scene, "modes.2");
  const ErrorBudget budget  = budget_of(whole.scene, outputs);
  EXPECT_EQ(budget.entries.at(0).total, 0.);
  EXPECT_EQ(budget.entries.at(0).unit, "Hz");
  EXPECT_EQ(budget.entries.at(0).reduction.reason, "the frame is not reduced");
}

/// The proof holds what the tolerance promises, on models far below the whole one.
TEST(SizeSearch, MeetsItsToleranceWithFewModes)
{
  int before = 0;
  for (const double tolerance : {0.05, 0.01, 0.002})
  {
    const Read  read(rod("modes = 8", by_steps));
    const auto  outputs = of_scene(read.scene, "x.max,x.min,modes.2");
    SizeOptions options;
    options.tolerance      = tolerance;
    const SizedModel model = size_search(read.scene, outputs, options);
    ASSERT_TRUE(model.result.met) << model.result.stopped;
    ASSERT_EQ(model.result.proof.size(), outputs.size());
    const ModelAnswer truth = answer_of(read.scene, {1., links - 1, finest_method(read.scene)}, outputs);
    for (std::size_t i = 0; i < outputs.size(); ++i)
      EXPECT_LE(std::abs(model.result.proof[i].value - truth.values[i]), tolerance * truth.sizes[i]) << outputs[i].text;
    EXPECT_GE(model.chosen.modes, before);
    EXPECT_LT(model.chosen.modes, links / 2);
    before = model.chosen.modes;
  }
}

/// The scene it writes is the model it chose, with what was typed beside it.
TEST(SizeSearch, WritesTheChosenModelAsAScene)
{
  test::SceneFolder        folder;
  const std::string        path      = folder.write("scene.toml", test::quoted(rod("modes = 8", by_steps)));
  std::vector<std::string> overrides = {"run.end=0.05", "run.step=1e-5"};
  const Scene              scene     = read_scene(path, overrides);
  ModelVariant             model;
  model.modes             = 6;
  model.method            = finest_method(scene);
  model.method->tolerance = 1e-4;
  const Scene sized = read_scene(folder.write("sized.toml", sized_scene(scene, overrides, model, folder.path("."))));
  EXPECT_EQ(sized.reduction.options.n_modes, 6);
  EXPECT_EQ(sized.run.options.method.method, "exact");
  EXPECT_EQ(sized.run.options.method.order, 8);
  EXPECT_EQ(sized.run.options.method.tolerance, 1e-4);
  EXPECT_EQ(sized.run.options.method.step, model.method->step);
  EXPECT_EQ(sized.run.options.end, 0.05);
}

/// Parts have meshes of their own, one that is the same as another has its mesh; a reduction is written beside its
/// modes.
TEST(SizeSearch, WritesMeshesOfPartsAndReductions)
{
  const std::string press = shipped("tie_rod_press.toml");
  test::SceneFolder folder;
  const Scene       parts = read_scene(press);
  ModelVariant      model;
  model.mesh        = 1.5;
  model.modes       = 6;
  const Scene sized = read_scene(folder.write("sized.toml", sized_scene(parts, {}, model, folder.path("."))));
  ASSERT_EQ(sized.frame.parts.parts.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(sized.frame.parts.parts[i].geometry.mesh.size, 1.5 * parts.frame.parts.parts[i].geometry.mesh.size,
                1e-12);
  EXPECT_EQ(sized.reduction.options.n_modes, 6);
  EXPECT_TRUE(sized.frame.parts.all_modes);

  const std::string file  = folder.write("rod.toml", test::quoted(rod("modes = 8", by_steps)));
  const Scene       given = read_scene(file);
  ModelVariant      free;
  free.modes     = 6;
  free.reduction = "free-interface";
  EXPECT_EQ(read_scene(folder.write("free.toml", sized_scene(given, {}, free, folder.path(".")))).reduction.method,
            "free-interface");
}

TEST(SizeSearch, RefusesTolerancesThatNoModelHas)
{
  const Read read(rod("modes = 8", by_steps));
  const auto outputs = of_scene(read.scene, "x.max");
  for (const double tolerance : {0., -1., 1e-9, 2.})
  {
    SizeOptions options;
    options.tolerance = tolerance;
    EXPECT_THROW(size_search(read.scene, outputs, options), std::invalid_argument) << tolerance;
  }
}

TEST(OutputName, IsRefusedWithTheWayOut)
{
  const std::vector<std::string> signals = {"F_P", "x slide"};
  for (const auto &[given, words] :
       {std::pair("F_Q.max", "did you mean F_P.max?"), std::pair("F_P", "name one of its numbers: F_P.max"),
        std::pair("F_P.mean", "valid: max, min"), std::pair("events", "is a count"),
        std::pair("work.steps", "is a count"), std::pair("modes.9", "is not among the 4 listed modes"),
        std::pair("modes.x", "needs the number of a mode")})
    try
    {
      output_named(given, signals, 4);
      ADD_FAILURE() << given;
    }
    catch (const std::invalid_argument &refused)
    {
      EXPECT_THAT(refused.what(), testing::HasSubstr(words)) << given;
    }
  EXPECT_EQ(outputs_named(" F_P.max , x slide.t_min,modes.2", signals, 4).size(), 3u);
  EXPECT_EQ(outputs_named("", signals, 4).size(), 4u);
}

/// Among all models about the chosen one it is there with the answer that it has, within the tolerance of the finer
/// one, as is the cheapest.
TEST(Size, ShowsAllModelsAboutTheChosenOne)
{
  const Read  rod_scene(rod("tolerance = 0.01", by_steps));
  const auto  outputs = of_scene(rod_scene.scene, "x.max,x.min");
  SizeOptions options;
  options.tolerance       = 0.02;
  options.exhaustive      = true;
  const SizeResult result = size_search(rod_scene.scene, outputs, options).result;
  ASSERT_TRUE(result.met);
  ASSERT_GT(result.all.size(), 1u);
  const SizeRung &chosen = result.all.at(result.chosen_of_all), &climbed = result.ladder.at(result.chosen);
  EXPECT_EQ(chosen.modes, climbed.modes);
  EXPECT_EQ(chosen.tolerance, climbed.tolerance);
  EXPECT_LE(chosen.share, 1.);
  ASSERT_NE(cheapest_of(result), nullptr);
  EXPECT_LE(cheapest_of(result)->cpu_s, chosen.cpu_s);
  double most = 0., size = 0.;
  for (const SizeProof &proof : result.proof)
  {
    most = std::max(most, std::abs(proof.value - proof.finer));
    size = std::max(size, std::abs(proof.finer)); // of the signal, whose extremes both are
  }
  EXPECT_NEAR(chosen.share, most / (options.tolerance * size), 1e-6);
}

/// The fourth mode of the held rod, the last that a loose tolerance keeps, has 400 Hz: a load of 350 Hz is near it.
TEST(Size, NamesLoadsNearTheHighestRetainedMode)
{
  for (const double hertz : {350., 2.})
  {
    std::string text = rod("tolerance = 0.01", by_steps);
    for (const std::string f : {"55", "170", "250"})
      text.replace(text.find("'" + f + " Hz'"), f.size() + 5, "'" + number(hertz) + " Hz'");
    const Read  scene(text);
    SizeOptions options;
    options.tolerance       = 0.2;
    const SizeResult result = size_search(scene.scene, of_scene(scene.scene, "x.max"), options).result;
    const double     cutoff = hertz == 350. ? 1. : 0.;
    EXPECT_EQ(result.missing.size(), std::size_t(cutoff));
    for (const std::string &what : result.missing)
      EXPECT_THAT(what, testing::HasSubstr("\"load\" acts with 350 Hz"));
  }
}

/// A stop that is never reached, a soft spring and a link far stiffer than the rod do nothing; the load does.
TEST(Size, NamesWhatMayBeLeftOut)
{
  std::string text = rod("tolerance = 0.01", by_steps);
  text.replace(text.find("gap = '1 mm'"), 12, "gap = '1 m'");
  text.replace(text.find("[output.signals]"), 0,
               "[element.thread]\ntype = 'spring-damper'\nfrom = 'frame.tip'\nto = 'ground'\ndirection = [1, 0, 0]\n"
               "stiffness = 1e-3\n[body.weight]\ntype = 'slider'\naxis = [1, 0, 0]\nmass = 0.05\n"
               "[element.link]\ntype = 'spring-damper'\nfrom = 'weight'\nto = 'frame.tip'\ndirection = [1, 0, 0]\n"
               "stiffness = 1e9\n");
  const Read  scene(text);
  SizeOptions options;
  options.tolerance       = 0.02;
  const SizeResult result = size_search(scene.scene, of_scene(scene.scene, "x.max,x.min"), options).result;
  std::string      reported;
  for (const std::string &what : result.left_out)
    reported += what + '\n';
  for (const std::string what : {"element \"stop\"", "element \"thread\"", "elasticity of \"link\"",
                                 "play, stops or sticking of \"stop\": no event"})
    EXPECT_THAT(reported, testing::HasSubstr(what));
  EXPECT_THAT(reported, testing::Not(testing::HasSubstr("element \"link\"")));
}

/// Whatever the scene gives of its method: the scene that is written answers with the numbers that were judged, to the
/// last bit.  Without a step it leaves the longest one to the method.
TEST(Size, WritesASceneThatGivesTheJudgedNumbersToTheLastBit)
{
  for (const std::string &run :
       {by_steps, std::string("method = 'exact'\norder = 6\ntolerance = 1e-6\nend = 0.06\n"),
        std::string("method = 'exact'\nforce = 'average'\nstep = 2e-5\nend = 0.06\n"),
        std::string("method = 'exact'\norder = 4\nstep = 1e-4\nnewton_tolerance = 1e-7\nmax_halvings = 3\n"
                    "end = 0.06\n"),
        std::string("method = 'generalised-alpha'\nrho_inf = 0.7\nstep = 2e-5\nend = 0.06\n"),
        std::string("method = 'newmark'\nbeta = 0.3\ngamma = 0.55\nstep = 2e-5\nend = 0.06\n")})
  {
    const Read  scene(rod("tolerance = 0.01", run));
    const auto  outputs = of_scene(scene.scene, "x.max,x.min,F.max,modes.2");
    SizeOptions options;
    options.tolerance           = 0.1;
    const SizedModel  model     = size_search(scene.scene, outputs, options);
    const auto        directory = std::filesystem::path(scene.folder.write("sized.toml", "")).parent_path();
    const std::string text      = sized_scene(scene.scene, {}, model.chosen, directory);
    const ModelAnswer sized     = answer_of(read_scene(scene.folder.write("sized.toml", text)), {}, outputs);
    const SizeRung   &judged    = model.result.ladder.at(model.result.chosen);
    for (std::size_t i = 0; i < outputs.size(); ++i)
      EXPECT_EQ(sized.values.at(i), judged.entries.at(i).value) << run << outputs[i].text << '\n' << text;
  }
}

/// With all its modes every reduction is the full rod; errors fall with their number, and statics alone err most.
TEST(ReductionComparison, OfARodComesToTheFullOne)
{
  const Read        rod_scene(rod("method = 'craig-bampton'", "method = 'exact'\ntolerance = 1e-10\nend = 0.06\n"));
  const auto        outputs = of_scene(rod_scene.scene, "x.max,x.min,F.max");
  ComparisonOptions options;
  options.full                         = true;
  options.modes                        = {4, 12, links - 1};
  const ReductionComparison comparison = compare_reductions(rod_scene.scene, outputs, options);
  EXPECT_EQ(comparison.reference.coordinates, links);
  std::map<std::string, std::vector<double>> errors;
  for (const ReductionPoint &point : comparison.points)
  {
    EXPECT_EQ(point.failure, "") << point.method;
    EXPECT_EQ(point.coordinates, (point.method == "modal" ? 0 : 1) + point.modes) << point.method;
    errors[point.method].push_back(point.error);
  }
  ASSERT_EQ(errors.size(), 4u);
  for (const std::string method : {"craig-bampton", "free-interface", "modal"})
  {
    ASSERT_EQ(errors[method].size(), 3u) << method;
    EXPECT_LT(errors[method][1], errors[method][0]) << method;
    EXPECT_LT(errors[method][2], 1e-8) << method; // the tolerance of the steps, a hundred times
  }
  for (const std::string method : {"craig-bampton", "free-interface"})
    EXPECT_GT(errors["guyan"].at(0), errors[method][0]) << method;
  EXPECT_GT(errors["modal"][0], errors["craig-bampton"][0]); // statics of the tip are exact there alone
}

TEST(ReductionComparison, NeedsAReducedFrame)
{
  const Read scene(rod("method = 'condensation'", by_steps));
  expect_refusal([&] { compare_reductions(scene.scene, of_scene(scene.scene, "x.max"), {}); }, "not reduced");
}

} // namespace gestell::tests

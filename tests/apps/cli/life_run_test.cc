// `gestell life` on a bar under a slow sine, whose stress is known: windows, blocks, welds and bad input.

#include "tests/support/csv_table.h"
#include "tests/support/program.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// The bar of apps/verification with other keys; its folder keeps what extends it.
class Bar
{
public:
  explicit Bar(const std::string &name) : folder_(name)
  {
    std::filesystem::create_symlink(scenes / "cantilever.geo", folder_ / "cantilever.geo");
    std::filesystem::create_symlink(scenes / "bar_life.toml", folder_ / "bar_life.toml");
  }
  Answer life(const std::string &more, const std::string &options = "") const
  {
    return gestell("life " + folder_.file("own.toml", "extends = 'bar_life.toml'\n" + more) + folder_.option() +
                   options);
  }
  /// `gestell life RESULT`
  Answer again(const std::string &options) const
  {
    return gestell("life '" + folder_.results().string() + "' --quiet" + options);
  }
  std::string summary_again() const { return read(folder_.results().string() + "_life/summary.json"); }
  /// Replaces the states of the run; returns those that were there.
  std::string states(const std::string &text) const
  {
    const std::string before = read(folder_.results() / "life_states.bin");
    std::ofstream(folder_.results() / "life_states.bin") << text;
    return before;
  }
  void remove(const std::string &file) const { std::filesystem::remove(folder_.results() / file); }
  /// A study of two forces: the damage of each.
  std::vector<double> damage_of(const std::string &first, const std::string &second) const
  {
    expect_answer(gestell("study " +
                          folder_.file("study.toml", "[scene]\nfile = 'bar_life.toml'\n[variables.F]\nkey = "
                                                     "'parameters.F'\nfrom = '" +
                                                         first + "'\nto = '" + second +
                                                         "'\n[outputs]\ndamage = 'life.damage'\n"
                                                         "[design]\ntype = 'full factorial'\nlevels = 2\n") +
                          folder_.option()),
                  0, {"2 runs made"});
    const CsvTable runs((folder_.results() / "runs.csv").string());
    return {runs.number(0, "damage"), runs.number(1, "damage")};
  }
  double number(const std::vector<std::string> &path) const { return json_number(summary(), path); }
  /// A number of --life-by.
  double derivative(const std::string &key, const std::string &name) const
  {
    const std::string all = summary();
    return json_number(all.substr(all.find("\"key\": \"" + key + '"')), {name});
  }
  CsvTable    cycles() const { return CsvTable((folder_.results() / "life_cycles.csv").string()); }
  std::string summary() const { return read(folder_.results() / "summary.json"); }
  std::string results() const { return folder_.results().string(); }
  bool        wrote(const std::string &file) const { return std::filesystem::exists(folder_.results() / file); }
  /// The scene that all extend, without its table [life].
  std::string scene_without_life() const
  {
    const std::string text  = read(scenes / "bar_life.toml");
    const std::size_t begin = text.find("[life]"), end = text.find("[output]");
    return text.substr(0, begin) + text.substr(end);
  }
  void        file(const std::string &name, const std::string &text) const { folder_.file(name, text); }
  std::string path(const std::string &name) const { return (folder_ / name).string(); }

private:
  const std::filesystem::path scenes = GESTELL_SOURCE_DIR "/apps/verification/scenes";
  Folder                      folder_;
};

/// Of class 71 at a range of 142 MPa, which is the bar's.
constexpr double damage = 8. / 2e6;
constexpr double slow   = 2e-5; // three times (omega/omega_1)^2, see apps/verification/frames.toml

TEST(LifeRun, TheLastStrokeCountsOnceAndIsComparedWithTheOneBefore)
{
  const Bar    bar("life_stroke");
  const Answer answer = bar.life("run = { end = '3 s' }\noutput.from = 'last period'\nlife.period = '4 s'\n");
  expect_answer(answer, 0, {"Life of the frame", "repetitions", "The damage of the last two windows differs"});
  EXPECT_NEAR(bar.number({"life", "damage"}), damage, slow * damage);
  EXPECT_NEAR(bar.number({"life", "hours"}), 4. / 3600. / damage, slow * 4. / 3600. / damage);
  EXPECT_LT(bar.number({"life", "stroke_change"}), slow);
  for (const char *file : {"life.csv", "life_cycles.csv", "life.vtp", "report.html"})
    EXPECT_TRUE(bar.wrote(file)) << file;
}

/// The weld's own class judges it; in a homogeneous stress extrapolation changes nothing.
TEST(LifeRun, AWeldAcrossTheStressHasItsHotSpot)
{
  const Bar bar("life_weld");
  bar.life("[[life.weld]]\nsurfaces = ['top', 'tip']\nthickness = '0.2 m'\ncurve = { class = 36 }\n");
  const double of_class_36 = damage * std::pow(71. / 36., 3);
  EXPECT_NEAR(bar.number({"life", "damage"}), of_class_36, slow * of_class_36);
  EXPECT_NE(bar.summary().find("\"of\": \"top to tip\""), std::string::npos);
}

/// The first block inherits the force and changes with it; the second sets its own, below the cut-off.
TEST(LifeRun, ChangesReachTheBlocksThatInheritTheirKeys)
{
  const Bar bar("life_changes");
  bar.file("same.toml", "extends = 'bar_life.toml'\n");
  bar.file("light.toml", "extends = 'bar_life.toml'\nparameters = { F = '0.5 MN' }\n");
  expect_answer(bar.life("[[life.block]]\nscene = 'same.toml'\nrepetitions = 10\n[[life.block]]\nscene = 'light.toml'\n"
                         "repetitions = 100\n",
                         " --set parameters.F='1.5*(3.55 MN)'"),
                0, {"Life of the frame"});
  const double eleven = 11. * std::pow(1.5, 3) * damage;
  EXPECT_NEAR(bar.number({"life", "damage"}), eleven, slow * eleven);
}

/// A block without [life] does not get one by a change of its keys.
TEST(LifeRun, ChangesOfLifeLeaveBlocksWithoutLifeAlone)
{
  const Bar bar("life_plain");
  bar.file("plain.toml", bar.scene_without_life());
  expect_answer(bar.life("[[life.block]]\nscene = 'plain.toml'\nrepetitions = 2\n", " --set life.repetitions=3"), 0,
                {"Life of the frame"});
  EXPECT_NEAR(bar.number({"life", "damage"}), 5. * damage, slow * 5. * damage);
  expect_answer(bar.again(" --set life.repetitions=5"), 0, {"Life of the frame"});
}

/// All members of summary.json but times, as they are written.
std::string life_members(const std::string &summary)
{
  const std::size_t begin = summary.find("\"life\": {"), end = summary.find("\"cpu_s\"", begin);
  return summary.substr(begin, end - begin);
}

/// With other keys of [life], among them one that reaches a block, as if the run were made again.
TEST(LifeRun, CountsTheStatesOfARunAgain)
{
  const Bar         bar("life_again");
  const std::string own     = "[[life.block]]\nscene = 'light.toml'\nrepetitions = 100\n[[life.weld]]\nsurfaces = "
                              "['top', 'tip']\nthickness = '0.2 m'\n";
  const std::string changes = " --set life.curve.class=63 --set life.repetitions=7 --set life.period=3";
  bar.file("light.toml", "extends = 'bar_life.toml'\nparameters = { F = '2 MN' }\n");
  bar.life(own, " --set parameters.T_s=1.5");
  expect_answer(bar.again(changes), 0, {"category 63", "results_life"});
  const std::string again = life_members(bar.summary_again());
  bar.life(own, " --set parameters.T_s=1.5" + changes);
  EXPECT_EQ(again, life_members(bar.summary()));
  EXPECT_GT(again.size(), 1000u);
}

TEST(LifeRun, NamesWhatStatesDependOn)
{
  const Bar bar("life_states");
  expect_answer(bar.again(""), 2, {"results"});
  bar.file("light.toml", "extends = 'bar_life.toml'\nparameters = { F = '2 MN' }\n");
  bar.life("[[life.block]]\nscene = 'light.toml'\n");
  expect_answer(bar.again(" --set life.step=0.01 --set life.strokes=2 --set run.end='4 s'"), 2,
                {"depend on life.step, run.end;", "gestell life SCENE"});
  expect_answer(bar.again(" -o '" + bar.results() + "'"), 2, {"life_states.bin"});
  bar.file("light.toml", "extends = 'bar_life.toml'\nparameters = { F = '1 MN' }\n");
  expect_answer(bar.again(""), 2, {"'parameters' of the block light.toml has changed since", "gestell life SCENE"});
  bar.file("light.toml", "extends = 'bar_life.toml'\nparameters = { F = '2 MN' }\n");
  expect_answer(bar.again(""), 0, {"Life of the frame"});
  expect_answer(gestell("life '" + bar.results() + "_none'"), 2,
                {"no such scene or folder", "life_states.bin: in", "'results'"});
  const std::string whole = bar.states("");
  expect_answer(bar.again(""), 2, {"life_states.bin", "gestell life SCENE"});
  bar.states(whole.substr(0, whole.size() - 1));
  expect_answer(bar.again(""), 2, {"is damaged", "gestell life SCENE"});
  bar.remove("life_states.bin");
  expect_answer(bar.again(""), 2, {"contains no life_states.bin", "[life]"});
  bar.remove("summary.json");
  expect_answer(bar.again(""), 2, {"contains no summary.json"});
}

TEST(LifeRun, IsAnOutputOfStudies)
{
  const std::vector<double> found = Bar("life_study").damage_of("3.55 MN", "5.325 MN");
  EXPECT_NEAR(found[0], damage, slow * damage);
  EXPECT_NEAR(found[1], std::pow(1.5, 3) * damage, slow * std::pow(1.5, 3) * damage);
}

/// Ten samples a period that lie 18 degrees beside every extreme, as every second of them does.
TEST(LifeRun, TheErrorOfSamplesBesideAllExtremesIsStated)
{
  const Bar bar("life_samples");
  bar.life("life.step = '0.1 s'\n");
  const double     missed = std::pow(std::cos(0.1 * M_PI), -3);
  constexpr double lag =
      3e-4; // of the bar, 2 zeta omega/omega_1 = 2.6e-4, shifts each sample by 3 tan 18 degrees of it
  EXPECT_NEAR(bar.number({"life", "damage"}), damage / missed, lag * damage);
  EXPECT_GT(bar.number({"life", "factor"}), missed);
  EXPECT_LT(std::log(bar.number({"life", "factor"})), 1.1 * std::log(missed)); // 0.93/0.9 of a sine, and the slow bar
}

/// A mass on a spring and the bar in series, with a dashpot, pulls at the bar with k_t F / |k_t - m w^2 + i b w|; its
/// range to the power -3 is the life.
TEST(LifeRun, DerivativesOfASineAreThoseOfItsTransferFunction)
{
  const Bar bar("life_transfer");
  bar.life(
      "without = ['element.load']\n[parameters]\nn_s = -5e7\nm_s = 6.3e5\nb_s = 2.4e6\n[body.mass]\ntype = 'slider'\n"
      "axis = [1, 0, 0]\nmass = 'm_s'\n[element.spring]\ntype = 'spring-damper'\nfrom = 'mass'\nto = 'frame.tip'\n"
      "direction = [1, 0, 0]\nstiffness = '-n_s'\n[element.pot]\ntype = 'spring-damper'\nfrom = 'mass'\nto = 'ground'\n"
      "direction = [1, 0, 0]\ndamping = 'b_s'\n[element.push]\ntype = 'force'\nfrom = 'mass'\ndirection = [1, 0, 0]\n"
      "harmonics = [{ amplitude = 'F', frequency = '1/T_s' }]\n[run]\nend = 16\n[life]\ncurve = { class = 36 }\n",
      " --life-by parameters.n_s,parameters.m_s,parameters.b_s,parameters.T_s,parameters.F");
  const double k = 5e7, m = 6.3e5, b = 2.4e6, w = 2. * M_PI, k_bar = 210e9 * 0.05 / 2.;
  const double k_t = k * k_bar / (k + k_bar), free = k_t - m * w * w, square = free * free + b * b * w * w;
  for (const auto &[key, exponent] :
       {std::pair("n_s", (1. - k_t * free / square) * k_bar / (k + k_bar)), std::pair("m_s", m * w * w * free / square),
        std::pair("b_s", -b * b * w * w / square), std::pair("T_s", (b * b * w * w - 2. * m * w * w * free) / square),
        std::pair("F", 1.)})
  {
    const std::string name = std::string("parameters.") + key;
    EXPECT_NEAR(bar.derivative(name, "exponent"), -3. * exponent, 1e-3 * std::abs(3. * exponent)) << key;
    EXPECT_LT(bar.derivative(name, "error"), 1e-3) << key;
  }
  EXPECT_EQ(count(bar.summary(), "\"note\": \"\""), 5);
}

/// The range of the fifth harmonic is half a percent below the cut-off, or far above it.
TEST(LifeRun, DerivativesNoteCyclesThatAppear)
{
  const Bar  bar("life_appear");
  const auto with_cut_off = [&](const std::string &range)
  {
    return bar.life("without = ['life.curve.class']\nlife.curve.table = [[1e5, '142 MPa'], [2e6, '" + range +
                        " Pa']]\n[parameters]\nf = '1 MN'\n[element.fast]\ntype = 'force'\nfrom = 'frame.tip'\n"
                        "direction = [1, 0, 0]\nharmonics = [{ amplitude = 'f', frequency = '5/T_s' }]\n",
                    " --life-by parameters.f");
  };
  expect_answer(with_cut_off("5e7"), 0, {"Life of the frame"});
  EXPECT_EQ(count(bar.summary(), "appear or vanish"), 0);
  const CsvTable cycles = bar.cycles();
  ASSERT_GT(cycles.rows(), 1);
  const double second = cycles.number(1, "range [Pa]");
  with_cut_off(std::to_string(second * 1.005));
  EXPECT_EQ(count(bar.summary(), "cycles with damage appear or vanish: "), 1);
  with_cut_off(std::to_string(second * 0.9));
  EXPECT_EQ(count(bar.summary(), "appear or vanish"), 0);
  EXPECT_LT(bar.derivative("parameters.f", "error"), 1e-3);
  bar.life("", " --life-by life.curve.class");
  EXPECT_NE(bar.summary().find("no derivative: "), std::string::npos); // there are only some classes
}

/// Both sides of a bore in two coarse cells, each with damage; a bar without one has no such place.
TEST(LifeRun, AllPlacesThatTheMeshDoesNotResolveAreNamed)
{
  const Bar bar("life_notch");
  bar.file("bore.geo",
           "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, -0.1, -0.125, 2, 0.2, 0.25};\nCylinder(2) = {1, -1, 0, "
           "0, 2, 0, 0.05};\nBooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };\n");
  const Answer notched = bar.life("frame.cad = 'bore.geo'\n");
  expect_answer(
      notched, 0,
      {"life: the mesh does not resolve (", "of skin, where the stresses of neighbouring elements differ by"});
  EXPECT_GE(count(notched.text, ", where the stresses of neighbouring elements"), 2) << notched.text;
  EXPECT_EQ(count(notched.text, "life: the mesh does not resolve"), 1);
  EXPECT_FALSE(bar.life("").says("does not resolve"));
}

/// The stress is 71 MPa.
TEST(LifeRun, StressesBeyondTheStrengthAreNamed)
{
  const Bar  bar("life_strength");
  const auto with = [&](const std::string &strength)
  { return bar.life("without = ['life.curve.class']\nlife.curve.strength = '" + strength + "'\n"); };
  expect_answer(with("60 MPa"), 0,
                {"linear elasticity and S-N curves are not valid at (", "reaches 71 MPa, but R_m is 60 MPa"});
  EXPECT_NEAR(bar.number({"life", "places", "von_mises"}), 71e6, slow * 71e6);
  EXPECT_FALSE(with("80 MPa").says("linear elasticity"));
}

TEST(LifeRun, BadInputIsRefusedWithItsRemedy)
{
  const Bar  bar("life_bad");
  const auto refused = [&](const std::string &more, const std::vector<std::string> &words)
  { expect_answer(bar.life(more), 2, words); };
  refused("life.curve = { class = 70 }\n", {"life.curve", "71"});
  const std::string own = "without = ['life.curve.class']\nlife.curve = ";
  refused(own + "{ table = [[1e4, '100 MPa'], [1e6, '120 MPa']] }\n", {"must fall: row 2"});
  refused(own + "{ strength = '490 MPa', material = 'wood' }\n", {"life.curve", "wood"});
  refused(own + "{ table = [[1e4, '300 MPa'], [1e6, '100 MPa']], ratio = -1 }\nlife.mean_stress = 'goodman'\n",
          {"needs the tensile strength"});
  refused("without = ['life.curve']\n", {"life: needs 'curve'"});
  refused("[[life.weld]]\nsurfaces = ['wall', 'tip']\n", {"matches no point of the skin"});
  refused("[[life.weld]]\nsurfaces = ['tp']\n", {"there is no [frame.surface.tp]", "did you mean"});
  refused("[[life.weld]]\nsurfaces = ['top', 'top']\n", {"names 'top' twice"});
  refused("frame.interface.tip.coupling = 'rigid'\n[[life.weld]]\nsurfaces = ['tip']\n",
          {"'tip' is rigid because of [frame.interface.tip]"});
  refused("life.repetitions = 0.5\n", {"needs a number of 1 or more"});
  refused("life.curve.slope = 5\n", {"life.curve.slope", "EN 13001-3-1"});
  refused("life.curve = { standard = 'EN 13001-3-1', stress_relieved = true }\n", {"stress_relieved", "EN 1993-1-9"});
  refused("[[life.weld]]\nsurfaces = ['top']\ndirection = [1, 0, 0]\nstress = 'shear'\n"
          "curve = { class = 80, stress_relieved = true }\n",
          {"stress_relieved", "a shear stress does not have"});
  refused("[[life.weld]]\nsurfaces = ['top']\ndirection = [0, 0, 1]\n", {"is normal to 'top'", "in this surface"});
  refused("[[life.weld]]\nsurfaces = ['wall', 'top']\n", {"first surface", "name the other surface first"});
  refused("[life.weld]\nsurfaces = 'top'\n", {"life.weld: ", "write [[life.weld]]"});
  refused("[[life]]\n", {"write [life], with single brackets"});
  refused("[[life.weld]]\nsurfaces = 'top'\n[[life.weld]]\nsurfaces = 'top'\n", {"life.weld[2]", "'name' of its own"});
  refused("[[life.weld]]\nsurfaces = 'top'\nname = 'skin'\n", {"life.weld[1]", "'name' of its own"});
  refused("[[life.block]]\nscene = 'own.toml'\n", {"own.toml:2: life.block[1]: names its own scene"});
  refused("life.repetitions = 1e308\n", {"at most 9e+15"});
  expect_answer(bar.life("", " --life-by parameters.G"), 2, {"--life-by parameters.G"});
  expect_answer(bar.life("", " --set life.curve.class=70"), 2,
                {": life.curve: with --set life.curve.class=70: ", "71"});
  bar.file("other.toml", "extends = 'bar_life.toml'\nrun.end = -1\n");
  refused("[[life.block]]\nscene = 'other.toml'\n", {"own.toml:2: life.block[1]: ", "other.toml:2: run.end"});
  bar.file("other.toml", "extends = 'bar_life.toml'\noutput.from = '5 s'\n");
  refused("[[life.block]]\nscene = 'other.toml'\n",
          {"own.toml:2: life.block[1]: ", "other.toml:2: output.from: is 5 s"});
  bar.file("other.toml", "extends = 'bar_life.toml'\nframe.material.E = '200 GPa'\n");
  refused("[[life.block]]\nscene = 'other.toml'\n", {"has a different frame", "material or dimensions differ"});
  bar.file("other.toml", "extends = 'bar_life.toml'\nreduction.modes = 4\n");
  refused("[[life.block]]\nscene = 'other.toml'\n", {"has a different frame", "4 modes", "8 modes"});
}

/// The run in its folder is neither replaced nor said to be.
TEST(LifeRun, ASceneWithoutLifeIsRefusedBeforeTheRun)
{
  const Bar bar("life_none");
  bar.life("");
  bar.file("none.toml", bar.scene_without_life());
  const Answer answer = gestell("life '" + bar.path("none.toml") + "' -o '" + bar.results() + "'");
  expect_answer(answer, 2, {"there is no [life]"});
  EXPECT_FALSE(answer.says("replaced")) << answer.text;
}

/// Failure at D = 0.3 shortens the life; a mean beyond the strength leaves none, with its reason.
TEST(LifeRun, FailsAtItsDamageSum)
{
  const Bar bar("life_sum");
  bar.life("life.curve.damage_sum = 0.3\n");
  EXPECT_NEAR(bar.number({"life", "damage"}), damage / 0.3, slow * damage / 0.3);
  expect_answer(bar.life("without = ['life.curve.class']\nlife.curve.strength = '30 MPa'\nlife.mean_stress = "
                         "'goodman'\nrun = { end = '1.5 s' }\noutput = { from = '1 s' }\n"), // 0 to 71 MPa
                0, {"reaches the tensile strength"});
  expect_answer(bar.life("life.curve.safety = 1e300\n"), 0, {"no life is left at (", "the damage exceeds all numbers"});
}

/// A stiffness and the sheet of the press that new projects begin with, in coarse cells:
/// `--life-by` integrates by `exact`, the central differences over another distance by a quarter of the scene's step.
TEST(LifeRun, DerivativesOfAPressAreThoseOfConvergedRuns)
{
  const Folder                folder("life_press");
  const std::filesystem::path templates = GESTELL_SOURCE_DIR "/apps/templates";
  std::filesystem::create_symlink(templates / "press.geo", folder / "NAME.geo");
  std::filesystem::create_symlink(templates / "press.toml", folder / "press.toml");
  const std::string scene =
      folder.file("own.toml", "extends = 'press.toml'\n[parameters]\nsheet = '10 mm'\ndepth = '12 mm'\n"
                              "[frame.mesh]\nsize = '250 mm'\nbearing = '120 mm'\n"
                              "[life]\ncurve = { class = 71 }\nperiod = '2 s'\n");
  const auto life = [&](const std::string &options)
  {
    const Answer answer = gestell("life " + scene + folder.option() + " --quiet" + options);
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    return read(folder.results() / "summary.json");
  };
  const std::vector<std::pair<std::string, std::string>> keys = {{"c_rod", "900 kN/mm"}, {"sheet", "10 mm"}};
  std::string                                            list;
  for (const auto &[key, value] : keys)
    list += (list.empty() ? "parameters." : ",parameters.") + key;
  const std::string own = life(" --life-by " + list);
  for (const auto &[key, value] : keys)
  {
    constexpr double h = 4e-3;
    double           damage[2];
    for (const int side : {0, 1})
      damage[side] = json_number(life(" --set run.step='\"2.5 us\"' --set parameters." + key + "='\"(" + value + ")*" +
                                      number(side == 1 ? 1. + h : 1. - h) + "\"'"),
                                 {"life", "damage"});
    const double      converged = -std::log(damage[1] / damage[0]) / (2. * h);
    const std::string here      = own.substr(own.find("\"key\": \"parameters." + key + '"'));
    const double      allowed   = 1e-3 * std::max(1., std::abs(converged));
    EXPECT_NEAR(json_number(here, {"exponent"}), converged, allowed) << key;
    EXPECT_LT(json_number(here, {"error"}), allowed) << key;
    EXPECT_EQ(here.find("\"note\": \"\""), here.find("\"note\"")) << key;
  }
}

/// A force of its own in a block with an offset, and a factor on both: with the cycle between the blocks no closed
/// case.
TEST(LifeRun, DerivativesOfBlocksAreThoseOfWholeRuns)
{
  const Bar         bar("life_block_derivatives");
  const std::string own = "[parameters]\nk = 1\n[element.load]\nharmonics = [{ amplitude = 'k*F', frequency = '1/T_s' "
                          "}]\n[life]\nrepetitions = 3\n[[life.block]]\nscene = 'block.toml'\nrepetitions = 2\n";
  bar.file("block.toml", "extends = 'own.toml'\nparameters = { F = '4 MN' }\nelement.load.constant = '1 MN'\n");
  const auto damage_with = [&](const std::string &key, double factor, const std::string &value)
  {
    bar.life(own, " --set parameters." + key + "='\"" + number(factor) + "*(" + value + ")\"'");
    return bar.number({"life", "damage"});
  };
  bar.life(own, " --life-by parameters.k,parameters.F");
  const std::string summary = bar.summary();
  for (const auto &[key, value] : {std::pair("k", "1"), std::pair("F", "3.55 MN")})
  {
    constexpr double  h      = 4e-3;
    const std::string here   = summary.substr(summary.find("\"key\": \"parameters." + std::string(key) + '"'));
    const double      change = std::log(damage_with(key, 1. + h, value) / damage_with(key, 1. - h, value));
    EXPECT_NEAR(json_number(here, {"exponent"}), -change / std::log((1. + h) / (1. - h)), 1e-3) << key;
    EXPECT_LT(json_number(here, {"error"}), 1e-3) << key;
  }
  const std::string of_F = summary.substr(summary.find("\"key\": \"parameters.F\""));
  EXPECT_GT(json_number(of_F, {"exponent"}), -2.); // of both blocks it would be -3
  EXPECT_LT(json_number(of_F, {"exponent"}), -0.1);
}

/// What a run cannot know is not a number; lives are printed with three digits.
TEST(LifeRun, OnlyFurtherRunsKnowTheErrorOfModes)
{
  const Bar    bar("life_error");
  const Answer plain = bar.life("");
  expect_answer(plain, 0, {"250 000 strokes or 69.4 h until failure", "--life-error adds those of modes"});
  EXPECT_NE(bar.summary().find("\"modes\": null"), std::string::npos);
  expect_answer(bar.life("", " --life-error"), 0, {", modes 1"});
  EXPECT_NEAR(bar.number({"life", "places", "factor", "modes"}), 1., slow);
}

/// A force at rest, from its equilibrium.
TEST(LifeRun, AConstantStressHasNoCycle)
{
  const Bar bar("life_constant");
  expect_answer(bar.life("element.load = { harmonics = [], constant = '3 MN' }\nstart.rule = 'static'\n"
                         "output.from = '1 s'\n"),
                0, {"No cycle, so no damage: the stress is constant, 60 MPa", "life: no cycle was counted"});
  EXPECT_EQ(bar.number({"life", "places", "cycles"}), 0.);
}

/// Three quarters of a period are one rise and fall; the stress does not return to where it began.
TEST(LifeRun, AnOpenLoadWarns)
{
  const Bar bar("life_short");
  expect_answer(bar.life("run = { end = '1.75 s' }\noutput = { from = '1 s' }\n"), 0,
                {"one rise and fall", "differs from that at its start by 50 %"});
  bar.life("parameters = { F = '0.5 MN' }\n"); // a range of 20 MPa, below the cut-off of 28.7 MPa
  EXPECT_EQ(bar.number({"life", "damage"}), 0.);
  EXPECT_NE(bar.summary().find("\"life\": null"), std::string::npos);
}

} // namespace
} // namespace gestell::tests

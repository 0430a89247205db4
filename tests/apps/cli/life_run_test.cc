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
  bool        wrote(const std::string &file) const { return std::filesystem::exists(folder_.results() / file); }
  void        file(const std::string &name, const std::string &text) const { folder_.file(name, text); }

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

TEST(LifeRun, IsAnOutputOfStudies)
{
  const std::vector<double> found = Bar("life_study").damage_of("3.55 MN", "5.325 MN");
  EXPECT_NEAR(found[0], damage, slow * damage);
  EXPECT_NEAR(found[1], std::pow(1.5, 3) * damage, slow * std::pow(1.5, 3) * damage);
}

/// A mass on a spring and the bar in series, with a dashpot, pulls at the bar with k_t F / |k_t - m w^2 + i b w|; its
/// range to the power -3 is the life.
TEST(LifeRun, DerivativesOfASineAreThoseOfItsTransferFunction)
{
  const Bar bar("life_transfer");
  bar.life(
      "without = ['element.load']\n[parameters]\nk_s = 5e7\nm_s = 6.3e5\nb_s = 2.4e6\n[body.mass]\ntype = 'slider'\n"
      "axis = [1, 0, 0]\nmass = 'm_s'\n[element.spring]\ntype = 'spring-damper'\nfrom = 'mass'\nto = 'frame.tip'\n"
      "direction = [1, 0, 0]\nstiffness = 'k_s'\n[element.pot]\ntype = 'spring-damper'\nfrom = 'mass'\nto = 'ground'\n"
      "direction = [1, 0, 0]\ndamping = 'b_s'\n[element.push]\ntype = 'force'\nfrom = 'mass'\ndirection = [1, 0, 0]\n"
      "harmonics = [{ amplitude = 'F', frequency = '1/T_s' }]\n[run]\nend = 16\n[life]\ncurve = { class = 36 }\n",
      " --life-by parameters.k_s,parameters.m_s,parameters.b_s,parameters.T_s,parameters.F");
  const double k = 5e7, m = 6.3e5, b = 2.4e6, w = 2. * M_PI, k_bar = 210e9 * 0.05 / 2.;
  const double k_t = k * k_bar / (k + k_bar), free = k_t - m * w * w, square = free * free + b * b * w * w;
  for (const auto &[key, exponent] :
       {std::pair("k_s", (1. - k_t * free / square) * k_bar / (k + k_bar)), std::pair("m_s", m * w * w * free / square),
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
  bar.file("other.toml", "extends = 'bar_life.toml'\nreduction.modes = 4\n");
  refused("[[life.block]]\nscene = 'other.toml'\n", {"has a different frame", "4 modes", "8 modes"});
}

/// Three quarters of a period are one rise and fall; the stress does not return to where it began.
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

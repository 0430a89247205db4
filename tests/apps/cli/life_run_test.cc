// `gestell life` on a bar under a slow sine, whose stress is known: windows, blocks, welds and bad input.

#include "tests/support/csv_table.h"
#include "tests/support/program.h"
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
  double      number(const std::vector<std::string> &path) const { return json_number(summary(), path); }
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

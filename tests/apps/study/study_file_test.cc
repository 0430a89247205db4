#include "apps/study/file/read_analysis.h"
#include "apps/study/file/read_design.h"
#include "fem/values/number_text.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"

namespace gestell::tests
{
namespace
{

using namespace apps;

const std::string the_scene  = "[scene]\nfile = '" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml'\n";
const std::string variables  = "[variables.c_P]\nfrom = '720 kN/mm'\nto = '1080 kN/mm'\n"
                               "[variables.s_cl]\nlevels = ['0.6 mm', '0.2 mm', '0.4 mm']\n";
const std::string outputs    = "[outputs]\nF = 'signals.F_P.max'\nG = '2*F'\n";
const std::string everything = the_scene + variables + outputs;

/// A study file that vanishes with the test.
struct Written
{
  explicit Written(const std::string &text) : path((folder / "study.toml").string())
  {
    folder.file("study.toml", text);
  }

  StudyFile       study(const std::vector<std::string> &set = {}) const { return read_study(path, set); }
  StudyPoints     points() const { return read_design(study()); }
  AnalysisRequest analysis(int n_runs) const { return read_analysis(study(), n_runs); }

  Folder      folder{"study_file"};
  std::string path;
};

TEST(StudyFile, VariablesAreParametersOfTheSceneInTheirOwnUnit)
{
  const StudyFile study = Written(everything).study();
  ASSERT_EQ(study.variables.size(), 2u);
  EXPECT_EQ(study.variables[0].variable.key, "parameters.c_P");
  EXPECT_EQ(study.variables[0].text(900.), "900 kN/mm");
  EXPECT_EQ(study.variables[1].variable.levels, (std::vector<double>{0.2, 0.4, 0.6}));
}

TEST(StudyFile, OverridesOfItsTablesChangeTheStudyOthersTheScene)
{
  const StudyFile study = Written(everything).study({"variables.c_P.to=\"1000 kN/mm\"", "run.step=\"5 us\""});
  EXPECT_EQ(study.overrides, (std::vector<std::string>{"run.step=\"5 us\""}));
  expect_refusal([] { Written(everything).study({"variables.c_P.to=\"700 kN/mm\""}); },
                 "needs a value above 'from' = 720");
}

TEST(StudyFile, AListIsTakenAsItIsWrittenAndRepeatedForLevels)
{
  const auto points =
      Written(everything + "[design]\ntype = 'list'\ncolumns = ['c_P']\nrows = [['800 kN/mm'], [811.1]]\n").points();
  ASSERT_EQ(points.levels.rows(), 6);
  EXPECT_EQ(points.levels(3, 0), 811.1);
  EXPECT_EQ(points.levels(3, 1), 0.2);
}

// -1 + 2 * 9/20 is not -0.1 but -0.09999999999999998 or -0.0999999999999992, as the coded value is rounded.
TEST(StudyFile, LevelsHaveNoDigitsOfRounding)
{
  const Written written(the_scene + "[variables.c_P]\nfrom = -1\nto = 1\n[variables.s_cl]\nfrom = 0.7\nto = 1.3\n" +
                        outputs + "[design]\ntype = 'full factorial'\nlevels = 21\n");
  const auto    levels = written.points().levels;
  for (Eigen::Index row = 0; row < levels.rows(); ++row)
    for (Eigen::Index j = 0; j < 2; ++j)
      EXPECT_LE(exact_text(levels(row, j)).size(), 5u) << exact_text(levels(row, j));
}

TEST(StudyFile, ValuesOfOutputsAreComparedWithTheirUnits)
{
  const std::vector<StudyOutput> reported{{"F", "N"}, {"G", "kg"}};
  const auto                     with = [&](const std::string &analysis)
  {
    return [&, analysis]
    { check_units(Written(everything + "[design]\ntype = 'list'\n" + analysis).analysis(9).claims, reported); };
  };
  expect_refusal(with("[optimise.goals.F]\nscale = '600 kg'\n"),
                 "study.toml:14: optimise.goals.F.scale: is in kg, but output F is in N");
  expect_refusal(with("[optimise.goals.F]\n[optimise.limits.G]\nmost = '5 mm'\n"),
                 "optimise.limits.G.most: is in m, but output G is in kg");
  expect_refusal(with("[optimise.goals.F]\n[optimise.goals.G]\n"), "give each goal a scale");
  expect_refusal(with("[choose.goals.F]\nscale = '1 kN'\n[choose.goals.G]\n"), "give each goal a scale");
  expect_refusal(
      [] {
        check_units({{{0, {1., {1., 0., 0.}}, "limit: "}}, {}}, {{"nu", ""}});
      },
      "limit: is in m, but output nu has no unit; use a matching unit, as a plain number");
  EXPECT_NO_THROW(with("[optimise.goals.F]\nscale = '600 kN'\n[optimise.limits.F]\nleast = 0\nmost = '1 MN'\n")());
  EXPECT_NO_THROW(with("[optimise.goals.F]\nscale = 1e5\n[optimise.goals.G]\nscale = '1 t'\n")());
}

TEST(StudyFile, WordsStandForThemselves)
{
  const Written written(the_scene + "[variables.law]\nkey = 'run.method'\nlevels = ['bdf', 'newmark']\n" + outputs +
                        "[design]\ntype = 'full factorial'\n");
  EXPECT_EQ(written.study().variables[0].text(written.points().levels(1, 0)), "newmark");
}

/// Files with the values that they stand for: numbers in the study, files in the scene.
TEST(StudyFile, TakesADimensionThatIsVariedByFiles)
{
  const auto with = [](const std::string &levels, const std::string &design = "type = 'full factorial'")
  {
    return the_scene + "[variables.wall]\nkey = 'frame.cad'\nlevels = [" + levels + "]\n" + outputs + "[design]\n" +
           design + "\n";
  };
  const std::string both = "{ file = 'b.step', value = '20 mm' }, { file = 'a.step', value = '15 mm' }";
  const Written     written(with(both));
  const auto        request = written.study().variables[0];
  EXPECT_EQ(request.variable.unit, "mm");
  EXPECT_EQ(request.variable.levels, (std::vector<double>{15., 20.}));
  EXPECT_EQ(request.file(15.), "a.step");
  EXPECT_EQ(request.file(20.), "b.step");
  EXPECT_EQ(request.text(20.), "20 mm");
  EXPECT_EQ(written.points().levels, (Eigen::MatrixXd(2, 1) << 15., 20.).finished());

  const auto says = [](const std::string &text, const std::string &words)
  { expect_refusal([&] { Written(text).points(); }, words); };
  says(with(both, "type = 'Sobol'\nruns = 4"), "those of wall are files; use \"full factorial\" or \"list\"");
  says(with(both, "type = 'list'\nrows = [['17 mm']]"), "variable wall: no file has the value 17 mm");
  says(with("{ file = 'a.step' }, { file = 'b.step', value = 2 }"), "needs a file with its value in each");
  says(with("{ file = 'a.step', value = 2 }, 'b.step'"), "needs a file with its value in each");
  says(with("{ file = 'a.step', value = 2 }, { file = 'b.step', value = 2 }"),
       "'a.step' and 'b.step' have the same value");
  says(with("{ file = 'a.step', value = 'thick' }, { file = 'b.step', value = 2 }"), "needs a number");
}

TEST(StudyFile, WhatIsWrongIsReportedWithItsPlace)
{
  const auto says = [](const std::string &text, const std::string &words)
  {
    expect_refusal(
        [&]
        {
          const Written     written(text);
          const StudyPoints points = written.points();
          written.analysis(points.design.n_runs());
        },
        words);
  };
  says(everything + "[desing]\ntype = 'Sobol'\n", "study.toml:11: unknown key 'desing'; did you mean 'design'?");
  says(everything, "needs a table [design]");
  says(everything + "[design]\ntype = 'sobol'\nruns = 4\n", "did you mean 'Sobol'?");
  says(everything + "[design]\ntype = 'Sobol'\nruns = 4\nalpha = 1.4\n",
       "study.toml:14: design.alpha: is a key of 'central composite', but the type is 'Sobol'");
  says(everything + "[design]\ntype = 'list'\ncolumns = ['c_P']\nrows = [['800 kN/m']]\n",
       "is in kN/m, other values in kN/mm");
  says(everything + "[design]\ntype = 'list'\ncolumns = ['c_p']\nrows = [[800]]\n",
       "there is no variable 'c_p'; did you mean 'c_P'?");
  says(the_scene + outputs, "needs variables");
  const auto one = [&](const std::string &variable)
  { return the_scene + "[variables.c_P]\n" + variable + "\n" + outputs + "[design]\ntype = 'full factorial'\n"; };
  says(one("from = '800 kN/mm'\nto = '800 kN/mm'"), "needs a value above 'from' = 800, got 800");
  says(one("levels = ['800 kN/mm']"), "needs an array of two values or more");
  says(one("levels = ['800 kN/mm', '800 kN/mm']"), "fewer than two different values");
  says(one("from = '1 N/m'\nto = '2 N/m'\nscatter = 'normal'\nwidth = '0 N/m'"),
       "width: needs a number above 0, got 0");
  says(everything + "[design]\ntype = 'Sobol'\nruns = 0\n", "study.toml:11: design: study: Sobol points");
  const std::string factorial = everything + "[design]\ntype = 'full factorial'\n";
  says(factorial + "[surface]\nconfidence = 1\n", "confidence: needs a number above 0 and below 1, such as 0.95");
  says(the_scene + "[variables.law]\nkey = 'run.method'\nlevels = ['bdf', 'newmark']\n" + outputs +
           "[design]\ntype = 'full factorial'\n[surface]\n",
       "variable law has text as levels, which cannot be interpolated");
  says(factorial + "[optimise.goals.f]\n", "there is no output 'f'; did you mean 'F'?");
  says(the_scene + variables, "needs a table [outputs]");
  says(everything + "run = '1'\n", "'run' is a column of runs.csv already");
  says(everything + "[variables.c2]\nkey = 'parameters.c_P'\nfrom = 1\nto = 2\n",
       "takes the value of variable c_P already");
  says(everything + "[variables.k]\nkey = 'parameters.c_P.value'\nfrom = 1\nto = 2\n",
       "'parameters.c_P.value' of variable k is a part of 'parameters.c_P' of variable c_P");
  says(everything + "[design]\ntype = 'Sobol'\nruns = 5\n[surface]\n", "has 6 coefficients, but the design has 5 runs");
  says(everything + "[design]\ntype = 'Sobol'\nruns = 9\n[optimise.goals.H]\n", "there is no output 'H'");
  says(everything + "[design]\ntype = 'Sobol'\nruns = 9\n[optimise]\ngoals = { F = {} }\nrobust = {}\n",
       "no variable scatters");
  says(everything + "[design]\ntype = 'Sobol'\nruns = 9\n[optimise]\ngoals = { F = {} }\npareto = 9\n",
       "a front needs two goals");
}

} // namespace
} // namespace gestell::tests

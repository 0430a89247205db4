#include "apps/scene/file/scene_file.h"
#include "apps/session/session.h"
#include "apps/study/file/event_kinds.h"
#include "apps/study/results/study_files.h"
#include "apps/study/runs/study_answer.h"
#include "tests/support/program.h"
#include "tests/support/reference_table.h"
#include "tests/support/refusal.h"

#include <regex>
#include <set>
#include <sstream>

namespace gestell::tests
{
namespace
{

using namespace apps;

const std::string shipped_studies = GESTELL_SOURCE_DIR "/apps/studies/";
const std::string press           = GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml";

/// All runs of a study file.
StudyAnswer answered(const std::string &file, const Folder &folder, const std::vector<std::string> &set = {},
                     int jobs = 1, const StudyShare &share = {})
{
  static const std::atomic<bool> never{false};
  const StudyFile                study  = read_study(file, set);
  const StudyPoints              points = read_design(study);
  StudyRunner                    runner(study, points.levels, fem::Scripts::harmless, {});
  StudyCall                      call;
  call.folder = folder.results();
  call.jobs   = jobs;
  call.share  = share;
  call.stop   = &never;
  return make_study(study, points, runner, call);
}

/// Numbers of a column.
Eigen::VectorXd column(const StudyAnswer &answer, const std::string &output)
{
  return answer.table.values.col(answer.table.output_index(output));
}

/// Two variables and a signal of the press, by few large steps.
const std::string small_study = "[scene]\nfile = '" + press +
                                "'\nset = { 'run.step' = '50 us', 'run.end' = '50 ms' }\n"
                                "[variables.c_P]\nfrom = '720 kN/mm'\nto = '1080 kN/mm'\n"
                                "[variables.s_cl]\nfrom = '0.2 mm'\nto = '0.6 mm'\n"
                                "[outputs]\nF = 'signals.F_P.max'\nrise = 'F/c_P'\nf2 = 'modes.2'\n"
                                "tool = 'events.sheet.tool_contact.first'\ntools = 'events.sheet.tool_contact.count'\n"
                                "frame = 'model.frame_mass'\n"
                                "[design]\ntype = 'full factorial'\nlevels = 3\n";

std::string small(const Folder &folder, const std::string &more = "")
{
  folder.file("small.toml", small_study + more);
  return (folder / "small.toml").string();
}

/// runs.csv without the times that runs took.
std::string rows_of(const Folder &folder)
{
  std::istringstream text(read(folder.results() / "runs.csv"));
  std::string        rows;
  for (std::string line; std::getline(text, line);)
    rows += line.substr(0, line.rfind(',')) + '\n';
  return rows;
}

// The reference is good to 1e-9; the tolerance of a run leaves 1e-6.
TEST(StudyRuns, OfThePressMeetTheReferenceOf24Experiments)
{
  const Folder      folder("press_24");
  const StudyAnswer answer    = answered(shipped_studies + "press_24.toml", folder);
  const auto        reference = read_reference("../press/doe.csv");
  ASSERT_EQ(answer.table.n_done(), 24);
  for (int run = 0; run < 24; ++run)
  {
    EXPECT_NEAR(column(answer, "F_P_max")[run] / reference[run].number("F_P_max_N"), 1., 1e-6) << run;
    EXPECT_NEAR(column(answer, "F_P_min")[run] / reference[run].number("F_P_min_N"), 1., 1e-6) << run;
    EXPECT_NEAR(column(answer, "weight")[run], reference[run].number("mass_kg"), 1e-9) << run;
  }
}

TEST(StudyRuns, AreTheRunsOfTheSceneWithTheseValues)
{
  const Folder      folder("study_one_run");
  const StudyAnswer answer = answered(small(folder), folder);
  Session session(press, {"run.step=50 us", "run.end=50 ms", "parameters.c_P=1080 kN/mm", "parameters.s_cl=0.2 mm"});
  const Result result = session.run();
  EXPECT_EQ(column(answer, "F")[6], result.run->signals.front().max);
  EXPECT_EQ(column(answer, "f2")[6], result.coupled_modes[1].frequency_hz);
  EXPECT_EQ(column(answer, "frame")[6], 22500.);
}

TEST(StudyRuns, HaveFormulasWithUnitsAndNothingWhereAnEventDidNotOccur)
{
  const Folder      folder("study_formulas");
  const StudyAnswer answer = answered(small(folder), folder);
  EXPECT_NEAR(column(answer, "rise")[0], column(answer, "F")[0] / 720e6, 1e-18);
  EXPECT_EQ(answer.table.outputs[std::size_t(answer.table.output_index("rise"))].unit, "m");
  EXPECT_TRUE(std::isnan(column(answer, "tool")[0])); // the sheet is met after 0.19 s
  EXPECT_EQ(column(answer, "tools")[0], 0.);
}

TEST(StudyRuns, AreTheSameSideBySideInSharesAndInOneProcess)
{
  const Folder one("study_one"), two("study_two"), three("study_three");
  answered(small(one), one);
  answered(small(two), two, {}, 2);
  answered(small(three), three, {}, 1, {1, 2});
  EXPECT_FALSE(answered(small(three), three, {}, 1, {2, 2}).interrupted);
  const StudyAnswer merged = answered(small(three), three);
  EXPECT_EQ(merged.n_made, 0);
  EXPECT_EQ(rows_of(two), rows_of(one));
  std::string whole = rows_of(three);
  EXPECT_EQ(whole.substr(0, whole.find('\n')), rows_of(one).substr(0, rows_of(one).find('\n')));
  EXPECT_EQ(merged.table.n_done(), 9);
}

TEST(StudyRuns, ThatFailAreReportedAndTheOthersGoOn)
{
  const Folder      folder("study_failed");
  const StudyAnswer answer = answered(small(folder), folder, {"outputs.root=\"sqrt(0.5 mm - s_cl)\""});
  EXPECT_EQ(answer.table.n_done(), 6);
  EXPECT_EQ(answer.n_failed(), 3);
  EXPECT_EQ(answer.table.runs[2].status, RunStatus::failed);
  EXPECT_THAT(rows_of(folder), ::testing::HasSubstr("takes the root of a negative number"));
}

TEST(StudyRuns, WithoutAValueInTheFirstAreFailedOnesInEveryProcess)
{
  const Folder folder("study_first_failed");
  for (const int jobs : {1, 3})
  {
    const StudyAnswer answer = answered(small(folder), folder, {"outputs.root=\"sqrt(s_cl - 0.3 mm)\""}, jobs);
    EXPECT_EQ(answer.table.n_done(), 6) << jobs;
    EXPECT_EQ(answer.table.runs[0].status, RunStatus::failed) << jobs;
  }
  for (const int jobs : {1, 3})
    for (const char *formula : {"signals.F_P.max + 1 kg", "model.frame_mas"})
    {
      const Folder lacking("study_lacking");
      EXPECT_NE(
          refusal([&] { answered(small(lacking), lacking, {std::string("outputs.F=\"") + formula + '"'}, jobs); }), "")
          << formula;
      EXPECT_FALSE(std::filesystem::exists(lacking.results() / "runs.csv"));
    }
}

// The play is above 0.3 mm in some runs of each design, and below in others.
TEST(StudyRuns, ThatFailLeaveTheOthersInEveryDesign)
{
  for (const char *design : {"{ type = 'list', rows = [['900 kN/mm', '0.2 mm'], ['900 kN/mm', '0.5 mm']] }",
                             "{ type = 'full factorial' }", "{ type = 'central composite', star = 'face-centred' }",
                             "{ type = 'Latin hypercube', runs = 4 }", "{ type = 'Sobol', runs = 4 }"})
  {
    const Folder      folder("study_design_failed");
    const StudyAnswer answer =
        answered(small(folder), folder, {std::string("design=") + design, "outputs.root=\"sqrt(s_cl - 0.3 mm)\""});
    EXPECT_TRUE(answer.complete()) << design;
    EXPECT_GT(answer.n_failed(), 0) << design;
    EXPECT_GT(answer.table.n_done(), 0) << design;
  }
}

TEST(StudyRuns, OfAFinishedStudyAreBegunAgainByRanksTogether)
{
  const Folder folder("study_anew");
  answered(small(folder), folder);
  EXPECT_EQ(answered(small(folder), folder, {}, 1, {1, 2, true}).n_made, 5);
  EXPECT_EQ(answered(small(folder), folder, {}, 1, {2, 2, true}).n_made, 4);
  EXPECT_EQ(answered(small(folder), folder).table.n_done(), 9);
}

TEST(StudyRuns, HaveTheirUnitsInTheHead)
{
  const Folder folder("study_head");
  answered(small(folder), folder);
  const std::string text = read(folder.results() / "runs.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')), "run,status,c_P [kN/mm],s_cl [mm],F [N],rise [m],f2 [Hz],tool [s],tools,"
                                             "frame [kg],cpu_s");
  const RowsText rows(read_study(small(folder), {}));
  EXPECT_TRUE(rows.is_head("run,status,c_P,s_cl,F,rise,f2,tool,tools,frame,cpu_s")) << "of an older version";
  EXPECT_FALSE(rows.is_head("run,status,c_P,s_cl,F,rise,f2,tool,tools,cpu_s"));
}

TEST(StudyRuns, HaveTheUnitsOfTheirOwnStudy)
{
  const Folder folder("study_units");
  answered(small(folder), folder);
  std::filesystem::remove(folder.results() / "runs.csv");
  const StudyAnswer share = answered(small(folder), folder, {"outputs.F=\"signals.F_P.t_max\""}, 1, {1, 2});
  EXPECT_EQ(share.table.outputs[0].unit, "s");
}

TEST(StudyRuns, AreNotGoneOnWithAfterAFileOfAnyVariantWasChanged)
{
  const Folder folder("study_files");
  for (const char *file : {"thin.geo", "thick.geo", "part.geo"})
    folder.file(file, std::string("// ") + file);
  folder.file("thick.geo", "Include \"part.geo\";");
  folder.file("s.toml", "[scene]\nfile = '" GESTELL_SOURCE_DIR "/apps/scenes/press.toml'\n"
                        "[variables.frame]\nkey = 'frame.cad'\n"
                        "choices = { thin = 'thin.geo', thick = 'thick.geo' }\n"
                        "[variables.c_P]\nfrom = '1 N/m'\nto = '2 N/m'\nscatter = 'normal'\nwidth = '1 N/m'\n"
                        "[outputs]\nF = 'signals.F_P.max'\n[design]\ntype = 'full factorial'\n");
  const auto record = [&](const std::vector<std::string> &set)
  {
    const StudyFile study = read_study((folder / "s.toml").string(), set);
    return record_of(study, SceneVariants(study, fem::Scripts::harmless), 4);
  };
  const StudyRecord before = record({});
  EXPECT_THAT(differences(before, record({"variables.c_P.width=2 N/m"})),
              ::testing::IsEmpty()); // rows stay as they are
  EXPECT_THAT(differences(before, record({"variables.c_P.to=3 N/m"})), ::testing::SizeIs(1));
  folder.file("part.geo", "// other plates");
  EXPECT_THAT(differences(before, record({})), ::testing::ElementsAre(::testing::HasSubstr("content of part.geo was")));
}

/// Kinds of the guards in the sources of a folder, as written: {"lift_off", Crossing::rising}, closing ? "taut" :
/// "slack".
std::set<std::string> guarded_kinds(const std::string &folder)
{
  const std::regex      guard("\\{\"([a-z_]+)\", *Crossing::"), branch("closing \\? \"([a-z_]+)\" : \"([a-z_]+)\"");
  std::set<std::string> kinds;
  for (const auto &file : std::filesystem::recursive_directory_iterator(GESTELL_SOURCE_DIR + folder))
  {
    if (!file.is_regular_file())
      continue;
    const std::string text = read(file.path());
    for (const std::regex &form : {guard, branch})
      for (std::sregex_iterator match(text.begin(), text.end(), form), end; match != end; ++match)
        for (std::size_t i = 1; i < match->size(); ++i)
          kinds.insert((*match)[i]);
  }
  return kinds;
}

TEST(EventKinds, AreThoseOfAllGuards)
{
  const std::set<std::string> guarded = guarded_kinds("/mechanism");
  EXPECT_GT(guarded.size(), 25u);
  for (const std::string &kind : guarded)
    EXPECT_TRUE(is_event_kind(kind)) << kind;
  EXPECT_TRUE(std::is_sorted(event_kinds().begin(), event_kinds().end()));
  EXPECT_TRUE(is_event_kind("sign_1_rises"));
  EXPECT_FALSE(is_event_kind("lift_of"));
}

// The limiter switches later the more it allows; the crane is followed for 0.3 s from there on.
TEST(StudyRuns, TakeParametersThatTheyDefine)
{
  const Folder folder("study_measure");
  folder.file("s.toml", "[scene]\nfile = '" GESTELL_SOURCE_DIR "/apps/scenes/crane_minimal.toml'\n"
                        "measure = { t_0 = 'events.limiter.first' }\n"
                        "[scene.set]\nrun = { method = 'bdf', order = 6, tolerance = 1e-9, end = 't_0 + 0.3 s' }\n"
                        "parameters = { t_0 = '2.65 s' }\n"
                        "[variables.limit]\nkey = 'switch.limiter.above'\nfrom = '280 kN'\nto = '300 kN'\n"
                        "[outputs]\nfirst = 'events.limiter.first'\nassumed = 't_0'\nend = 'signals.F_h.final'\n"
                        "[design]\ntype = 'full factorial'\n");
  const std::string file   = (folder / "s.toml").string();
  const StudyAnswer answer = answered(file, folder);
  ASSERT_EQ(answer.table.n_done(), 2);
  EXPECT_GT(column(answer, "first")[1], column(answer, "first")[0] + 0.1);
  for (int run = 0; run < 2; ++run)
    EXPECT_NEAR(column(answer, "assumed")[run] / column(answer, "first")[run], 1., 1e-9);
  const Folder two("study_measure_two");
  EXPECT_EQ(answered(file, two, {}, 2).table.values, answer.table.values);
  const auto with = [&](const std::string &set) { return [&, set] { answered(file, two, {set}); }; };
  expect_refusal(with("scene.measure={t_1=\"events.limiter.first\"}"), "has no such parameter");
  expect_refusal(with("scene.measure={t_0=\"events.limitter.first\"}"), "did you mean 'limiter'?");
  expect_refusal(with("variables.limit.key=\"parameters.t_0\""), "is varied by variable limit");
}

// A table of the study takes the place of the scene's; in a scene that extends it, the two would be merged.
TEST(OptimumScene, HasNothingOfTheTablesThatTheStudyReplaces)
{
  const Folder        folder("study_optimum_scene");
  const StudyFile     study = read_study(shipped_studies + "press_24.toml", {"run.order=4"});
  const SceneVariants variants(study, fem::Scripts::harmless);
  folder.file("optimum.toml", optimum_scene(study, variants, variants.middle(), folder / ""));
  const SceneNode written = read_scene_file((folder / "optimum.toml").string(), {});
  for (const char *table : {"run", "start"})
  {
    std::set<std::string> theirs, ours;
    for (const auto &entry : variants.root().find(table)->entries)
      ours.insert(entry.first);
    for (const auto &entry : written.find(table)->entries)
      theirs.insert(entry.first);
    EXPECT_EQ(theirs, ours) << table;
  }
  EXPECT_EQ(written.find("run")->find("order")->number, 4.);
}

TEST(OptimumScene, LeavesOutWhatLiesDeeperThanANamedEntry)
{
  const Folder    folder("study_optimum_deep");
  const StudyFile study = read_study(shipped_studies + "crane_braking.toml", {});
  Eigen::VectorXd levels(5);
  levels << 2., 0.8, 1.24, 0., 0.; // two ramps
  const SceneVariants variants(study, fem::Scripts::harmless);
  folder.file("optimum.toml", optimum_scene(study, variants, levels, folder / ""));
  const SceneNode  written = read_scene_file((folder / "optimum.toml").string(), {});
  const SceneNode *brake   = written.find("joint")->find("cylinder")->find("motion")->find("brake");
  EXPECT_EQ(brake->find("family")->text, "shaped");
  EXPECT_EQ(brake->find("ramps")->elements.size(), 2u);
  folder.file("wrong.toml", "extends = 'optimum.toml'\nwithout = ['joint.cylinder.motion.break']\n");
  expect_refusal([&] { read_scene_file((folder / "wrong.toml").string(), {}); },
                 "without: 'joint.cylinder.motion.break': the base scene has no such table");
  folder.file("plain.toml", "extends = 'optimum.toml'\nwithout = ['joint.cylinder.motion.brake']\n");
  const SceneNode plain = read_scene_file((folder / "plain.toml").string(), {});
  EXPECT_FALSE(plain.find("joint")->find("cylinder")->find("motion")->find("brake"));
}

/// The press by a controlled step, and what it makes of stiffness and play.
const std::string fine_study =
    "[scene]\nfile = '" + press +
    "'\nset = { run = { method = 'bdf', tolerance = 1e-9, end = '0.25 s' } }\n"
    "[variables.c_P]\nfrom = '720 kN/mm'\nto = '1080 kN/mm'\n"
    "[variables.s_cl]\nfrom = '0.2 mm'\nto = '0.6 mm'\n"
    "[outputs]\nspread = 'signals.F_P.max - signals.F_P.min'\nrise = 'spread/c_P'\nf2 = 'modes.2'\n"
    "[design]\ntype = 'full factorial'\n";

// Quotients of runs that are accurate to 1e-8 over 2 % of the range err by 1e-6 for their own curvature and noise.
TEST(StudyRuns, HaveTheDerivativesOfTheirOutputs)
{
  const Folder folder("study_derivatives");
  folder.file("fine.toml", fine_study);
  const StudyFile       study  = read_study((folder / "fine.toml").string(), {});
  const StudyPoints     points = read_design(study);
  StudyRunner           runner(study, points.levels, fem::Scripts::harmless, {});
  const Eigen::Vector2d at(900., 0.4);
  Eigen::MatrixXd       derivatives;
  const RunRow          row = runner.run(1, at, nullptr, &derivatives);
  ASSERT_EQ(row.status, RunStatus::done) << row.message;
  for (int i = 0; i < 2; ++i)
  {
    Eigen::Vector2d step = Eigen::Vector2d::Zero();
    step[i]              = i == 0 ? 1. : 0.001;
    const RunRow above = runner.run(2, at + step, nullptr), below = runner.run(3, at - step, nullptr);
    for (int j = 0; j < 3; ++j)
    {
      const double quotient = (above.values[j] - below.values[j]) / (2. * step[i]);
      EXPECT_NEAR(derivatives(j, i), quotient, 1e-4 * std::abs(row.values[j]) / at[i]) << j << " by " << i;
    }
  }
}

TEST(StudyRuns, OfAnotherStudyOrOfOneThatWasChangedAreNotGoneOnWith)
{
  const Folder folder("study_changed");
  answered(small(folder), folder, {}, 1, {1, 2});
  const auto with = [&](const std::string &set) { return [&, set] { answered(small(folder), folder, {set}); }; };
  expect_refusal(with("design.levels=2"), "design.levels was 3, is 2");
  expect_refusal(with("run.step=20 us"), "scene.run.step was \"50 us\", is \"20 us\"");
  expect_refusal(with("scene.set={ 'run.end' = '50 ms' }"), "scene.run.step was \"50 us\", is \"10 us\"");
  EXPECT_EQ(answered(small(folder), folder, {"surface.order=\"linear\""}).n_made, 4); // made of the same rows
  folder.file("other.toml", small_study);
  expect_refusal([&] { answered((folder / "other.toml").string(), folder); },
                 "contains rows of the study 'small', but this study is 'other'");
}

TEST(StudyRuns, AreRefusedBeforeTheFirstWhereTheSceneCannotDoThem)
{
  const Folder folder("study_refused");
  const auto   with = [&](const std::string &set) { return [&, set] { answered(small(folder), folder, {set}); }; };
  expect_refusal(with("variables.c_P.key=\"parameters.cP\""),
                 "has no parameter 'cP' in parameters; did you mean 'c_P'?");
  expect_refusal(with("variables.c_P.key=\"element.rot.stiffness\""),
                 "has no key 'rot' in element; did you mean 'rod'?");
  expect_refusal(with("variables.c_P.key=\"element.rod\""), "is a table of the scene");
  expect_refusal(with("variables.s_cl.from=\"-0.1 mm\""),
                 "small.toml:7: variables.s_cl: with --set variables.s_cl.from=\"-0.1 mm\": -0.1 mm of variable s_cl "
                 "the scene does not accept");
  expect_refusal(with("outputs.F=\"signals.FP.max\""), "names no signal of the scene");
  expect_refusal(with("outputs.F=\"modes.6\""), "needs the number of a mode from 1 to 5"); // by the first run
  expect_refusal(with("outputs.F=\"events.sheat.count\""), "did you mean 'sheet'?");
  expect_refusal(with("outputs.F=\"stress.max\""), "add [output.stress]");
  expect_refusal(with("outputs.F=\"2*Q\""), "there is no 'Q' (character 3)");
  expect_refusal(with("outputs.F=\"signals.F_P.max + 1 kg\""), "\"signals.F_P.max + 1 kg\" adds kg to N");
  expect_refusal(with("outputs.F=\"rise\""), "depends on itself");
}

} // namespace
} // namespace gestell::tests

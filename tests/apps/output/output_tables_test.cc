#include "apps/analysis/result_folder.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/tables/mode_tables.h"
#include "apps/output/tables/result_tables.h"
#include "apps/output/tables/story_table.h"
#include "apps/output/tables/summary_json.h"
#include "apps/output/text/change_text.h"
#include "apps/output/text/csv.h"
#include "apps/output/text/json.h"
#include "apps/output/text/write_file.h"
#include "coupling/frame/atomic_file.h"
#include "coupling/simulation/checks/contacts_and_switches.h"
#include "fem/values/number_text.h"
#include "tests/support/output_example.h"
#include "tests/support/program.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include <random>

using namespace gestell;
using namespace gestell::apps;
namespace fs = std::filesystem;

namespace
{

/// A folder of its own for each test.
class ResultFolder : public ::testing::Test
{
protected:
  const tests::Folder vanishing{"results"};
  const fs::path      folder = vanishing / "own";
};

std::vector<std::string> lines_of(const std::string &text)
{
  std::vector<std::string> lines;
  std::istringstream       stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

} // namespace

TEST(NumberText, ReadsBackExactlyForAnyDouble)
{
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i)
  {
    const std::uint64_t bits = random();
    double              x;
    std::memcpy(&x, &bits, sizeof x);
    if (!std::isfinite(x))
      continue;
    ASSERT_EQ(std::strtod(exact_text(x).c_str(), nullptr), x);
  }
  EXPECT_EQ(exact_text(0.1), "0.1");
}

TEST(NumberText, ShowsSIUnitsWithThePrefixThatReadsWell)
{
  EXPECT_EQ(display_unit("N", 1.0566e6).unit, "kN");
  EXPECT_DOUBLE_EQ(display_unit("N", 1.0566e6).factor * 1.0566e6, 1056.6);
  EXPECT_EQ(display_unit("m", 6e-4).unit, "µm");
  EXPECT_EQ(display_unit("rad", 6e-4).unit, "rad");
  EXPECT_EQ(display_unit("N", 0.).factor, 1.);
  EXPECT_EQ(short_text(1056.632), "1057");
  EXPECT_EQ(short_text(0.24), "0.24");
  EXPECT_EQ(short_text(-0.), "0");
  EXPECT_EQ(short_text(1.5e-9), "1.5e-09");
}

TEST(Json, EscapesTextAndHasNullForWhatIsNotANumber)
{
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(json_text({{"a\"b", "line\n\\tab\t\x01 µ \xff"}, {"x", {1. / 3., std::nan(""), infinite}}}),
            "{\n  \"a\\\"b\": \"line\\n\\\\tab\\t\\u0001 µ \xef\xbf\xbd\",\n"
            "  \"x\": [\n    0.3333333333333333,\n    null,\n    null\n  ]\n}\n");
}

TEST(Tables, CsvTakesNumbersTextsListsAndWhatIsNotKnown)
{
  CsvTable csv({"a", "b, c"});
  csv.add(0.1, "x\"y");
  csv.add(unless_nan({1., std::nan("")}));
  csv.add(true, std::variant<double, std::string>("word"));
  csv.add_rows({1., 2., 3.});
  EXPECT_EQ(std::string(csv), "a,\"b, c\"\n0.1,\"x\"\"y\"\n1,\n1,word\n1,2\n");
  EXPECT_EQ(std::string(CsvTable()), "");
}

TEST(Tables, HistoryKeepsEveryDigitAndNamesUnits)
{
  const Result result = example_result(50);
  const auto   lines  = lines_of(history_csv(*result.run));
  ASSERT_EQ(lines.size(), 51u);
  EXPECT_EQ(lines[0].substr(0, 25), "t [s],F_P [N],F_u [N],x1 ");

  std::istringstream row(lines[50]);
  std::string        field;
  for (std::size_t j = 0; std::getline(row, field, ','); ++j)
    EXPECT_EQ(std::strtod(field.c_str(), nullptr), result.run->rows[49 * 8 + j]);
}

TEST(Tables, ModesOfFrameAndMachineAreNumberedSeparately)
{
  Result result                         = example_result();
  result.coupled_modes[0].damping_ratio = std::nan("");
  result.frame_modes[1].refined_hz      = 84.5;
  const auto lines                      = lines_of(modes_csv(result));
  EXPECT_EQ(Json::parse(summary_json(result))["frame_refined_frequencies_hz"].dump(), "[null,84.5]");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[0], "mode,frequency [Hz],damped frequency [Hz],damping ratio,effective mass x [kg],effective mass y "
                      "[kg],effective mass z [kg],kind,growth [1/s],refined frequency [Hz]");
  EXPECT_EQ(lines[2].substr(0, 5), "2,85,");
  EXPECT_EQ(lines[3].substr(0, 19), "1,11.58486756566711");
  EXPECT_EQ(lines[2].substr(lines[2].rfind(',')), ",84.5");
  EXPECT_EQ(lines[3].substr(lines[3].rfind(',')), ",nan") << "of the coupled machine none is known";
  EXPECT_NE(lines[3].find(",nan,100,0,0.6666666666666666,coupled"), std::string::npos);
}

TEST(Tables, WarningsTellTheEarlyEndFirstAndNothingTwice)
{
  Result result       = example_result();
  result.run->failure = "Newton did not converge at t = 0.2 s";
  result.run->warn("", "", "The mesh is coarse.");
  const auto warnings = all_warnings(result);
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_NE(warnings[0].find("stopped early: Newton"), std::string::npos);
}

TEST(Tables, FindingsHaveTheirKindAndPlace)
{
  Result result   = example_result();
  result.warnings = {
      "press.toml:12: element.stop: never acts in this run; expected: a force at some time; check its gap",
      "press.toml:3: frame.mesh: is coarse", "of no place"};
  result.run->findings.clear();
  result.run->stop(coupling::ended_by_switch, "far",
                   "at t = 0.2 s, enough: x lies above 1, where switch \"far\" ends the run");
  const auto findings = all_findings(result);
  ASSERT_EQ(findings.size(), 4u);
  EXPECT_TRUE(is_wanted_end(*result.run));
  EXPECT_EQ(findings[0].id, "ended-by-switch");
  EXPECT_EQ(findings[0].place, "far");
  EXPECT_EQ(findings[0].text.find("A switch ended the run: at t = 0.2 s"), 0u);
  EXPECT_EQ(findings[1].id, "magnitude");
  EXPECT_EQ(findings[1].place, "element.stop");
  EXPECT_EQ(findings[2].id, "scene");
  EXPECT_EQ(findings[2].place, "frame.mesh");
  EXPECT_EQ(findings[3].place, "");
}

TEST_F(ResultFolder, IsCreatedWithItsParentsAndClearedOfOwnFilesOnly)
{
  fs::create_directories(folder / "charts");
  for (const char *name : {"summary.json", "mesh_convergence.csv", "charts/1-forces.svg"})
    OwnFolder(folder).write(name, "old");
  for (const char *name : {"notes.txt", "charts/mine.png"})
    std::ofstream(folder / name) << "old";
  prepare_folder(folder);
  EXPECT_FALSE(fs::exists(folder / "summary.json"));
  EXPECT_FALSE(fs::exists(folder / "mesh_convergence.csv")); // of another mesh than the next summary
  EXPECT_FALSE(fs::exists(folder / "charts/1-forces.svg"));
  EXPECT_TRUE(fs::exists(folder / "notes.txt"));
  EXPECT_TRUE(fs::exists(folder / "charts/mine.png"));

  prepare_folder(folder / "deep" / "er");
  EXPECT_TRUE(fs::is_empty(folder / "deep" / "er"));
}

TEST_F(ResultFolder, ThatCannotBeWrittenIsRefusedWithPathReasonAndRemedy)
{
  fs::create_directories(folder);
  std::ofstream(folder / "file") << "in the way";
  for (const fs::path &bad : {folder / "file", folder / "file" / "below", fs::path("/proc/gestell"), fs::path()})
  {
    const std::string message = tests::refusal([&] { prepare_folder(bad); });
    EXPECT_NE(message.find(bad.string()), std::string::npos) << message;
    EXPECT_NE(message.find("-o DIR"), std::string::npos) << message;
  }
}

TEST_F(ResultFolder, IsTestedWithoutLeavingATrace)
{
  fs::create_directories(folder);
  std::ofstream(folder / "summary.json") << "old";
  require_writable(folder);
  EXPECT_EQ(tests::read(folder / "summary.json"), "old");
  require_writable(folder / "deep" / "er" / "");
  EXPECT_FALSE(fs::exists(folder / "deep"));
  fs::current_path(folder);
  require_writable("results/press");
  EXPECT_FALSE(fs::exists(folder / "results"));
  fs::current_path(GESTELL_BINARY_DIR);
}

/// Wherever the disk becomes full, files are whole or missing, and the summary tells which, if there is room for it.
TEST_F(ResultFolder, OnAFullDiskHoldsWholeFilesOnlyAndReportsWhatIsMissing)
{
  const fs::path all = folder / "all", cut = folder / "cut";
  prepare_folder(all);
  rlim_t largest = 0;
  for (const std::string &name : write_results(all, example_result()))
    largest = std::max<rlim_t>(largest, fs::file_size(all / name));
  EXPECT_FALSE(incomplete(all));

  for (const rlim_t most : {largest / 100, largest / 10, largest / 3, largest - 1})
  {
    const pid_t child = fork();
    if (child == 0)
    {
      std::signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{most, most};
      setrlimit(RLIMIT_FSIZE, &limit);
      bool reported = false;
      try
      {
        prepare_folder(cut);
        write_results(cut, example_result());
      }
      catch (const coupling::WriteFailure &failure)
      {
        reported = std::string(failure.what()).find("all other results are in " + cut.string()) != std::string::npos;
      }
      _exit(reported ? 0 : 1);
    }
    int status = 1;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0) << most;
    if (fs::exists(cut / "summary.json"))
    {
      EXPECT_NE(tests::read(folder / "cut/summary.json").find("cannot be written"), std::string::npos) << most;
    }
    for (const auto &entry : fs::recursive_directory_iterator(cut))
      if (entry.is_regular_file() && entry.path().filename() != "summary.json" &&
          entry.path().filename() != ".gestell-files")
      {
        EXPECT_EQ(entry.file_size(), fs::file_size(all / fs::relative(entry.path(), cut))) << entry.path();
      }
  }
  std::ofstream(cut / "history.csv") << "t [s]\n";
  fs::remove(cut / "summary.json");
  EXPECT_TRUE(incomplete(cut));
}

TEST(CsvField, IsQuotedWhereItMustBeWithItsQuotesDoubled)
{
  EXPECT_EQ(csv_field("F_P [N]"), "F_P [N]");
  EXPECT_EQ(csv_field("F, largest"), "\"F, largest\"");
  EXPECT_EQ(csv_field("12\" pipe"), "\"12\"\" pipe\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
}

// What is not known is no zero: neither an energy, nor a number of a mode, nor modes where no state was kept.
TEST(StoryTable, SaysWhatIsNotKnown)
{
  RunStory story;
  story.loads.resize(1);
  LoadDuration &load = story.loads.front();
  load.signal        = "F";
  load.modes.push_back({-1, 10., 1., 0.1, 0.1, 1.});
  EXPECT_NE(story_text(story).find("–"), std::string::npos);
  Result result;
  result.story  = story;
  Json reported = Json::parse(summary_json(result))["story"]["loads"][0];
  EXPECT_TRUE(reported["modes"][0]["energy"].is_null());
  EXPECT_TRUE(reported["modes"][0]["mode"].is_null());
  load.modes.clear();
  load.unknown = "no state was stored near the end of the load";
  EXPECT_NE(story_text(story).find("no modes: no state was stored"), std::string::npos);
  EXPECT_EQ(story_text(story).find("energy [J]"), std::string::npos); // no head of a table without rows
  result.story = story;
  reported     = Json::parse(summary_json(result))["story"]["loads"][0];
  EXPECT_TRUE(reported["t_modes"].is_null());
}

// A pull that grows is larger, whatever its sign.
TEST(ChangeText, IsThatOfTheMagnitude)
{
  EXPECT_EQ(change_text(-100., -110.), "10 % larger");
  EXPECT_EQ(change_text(100., 110.), "10 % larger");
  EXPECT_EQ(change_text(-100., -90.), "10 % smaller");
  EXPECT_EQ(change_text(100., 0.), "100 % smaller");
}

TEST(ChangeText, IsNotAPercentageWhereNoneIsObserved)
{
  EXPECT_EQ(change_text(-100., 90.), "opposite sign");
  EXPECT_EQ(change_text(3., 3. * (1. + 1e-12)), "the same");
  EXPECT_EQ(change_text(0., 0.), "the same");
  EXPECT_EQ(change_text(0., 5.), "");
  EXPECT_EQ(change_text(1., std::nan("")), "");
}

// The program as its users meet it: files, exit codes and messages of the contract.

#include "tests/support/program.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

#include <chrono>

namespace gestell::tests
{
namespace
{

TEST(Program, RunLeavesEveryFileOfTheContract)
{
  const Folder folder("run");
  expect_answer(gestell("run " + scene("press_minimal.toml") + folder.option()), 0, {"report.html"});
  for (const char *name : {"summary.json", "history.csv", "modes.csv", "report.html"})
    EXPECT_GT(read(folder.results() / name).size(), 100u) << name;
  EXPECT_FALSE(std::filesystem::is_empty(folder.results() / "charts"));
  EXPECT_EQ(read(folder.results() / "history.csv").substr(0, 14), "t [s],F_P [N],");
  const std::string summary = read(folder.results() / "summary.json");
  for (const char *key : {"\"scene\"", "\"version\"", "\"model\"", "\"frequencies_hz\"", "\"signals\"", "\"events\"",
                          "\"work\"", "\"wall_s\"", "\"energy\"", "\"residual\"", "\"warnings\"", "\"conrod_open\""})
    EXPECT_NE(summary.find(key), std::string::npos) << key;
}

/// Loading, reading and writing included; the rest is the shell, the last file and the end of the process.
TEST(Program, PhasesOfARunAddUpToItsTime)
{
  const Folder folder("phases");
  const auto   begin = std::chrono::steady_clock::now();
  expect_answer(gestell("run " + scene("press_minimal.toml") + folder.option()), 0, {"report.html"});
  const double      whole   = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const std::string summary = read(folder.results() / "summary.json");
  const auto        phases  = nlohmann::json::parse(summary)["wall_s"];
  double            sum     = 0.;
  for (const char *phase : {"program", "scene", "frame", "start", "modes", "integration", "results", "analyses",
                            "earlier results", "tables", "report", "ParaView files"})
    sum += phases.at(phase).get<double>();
  EXPECT_EQ(phases.size(), 12u);
  EXPECT_LT(sum, whole);
  EXPECT_GT(sum, 0.5 * whole);
}

TEST(Program, ModesAndCheckWorkWithoutARun)
{
  const Folder folder("modes");
  expect_answer(gestell("modes " + scene("press_minimal.toml") + folder.option()), 0, {"84.675765"});
  EXPECT_FALSE(std::filesystem::exists(folder.results() / "history.csv"));
  const Answer check = gestell("check " + scene("press_minimal.toml"));
  EXPECT_EQ(check.exit_code, 0) << check.text;
}

TEST(Program, ModesOfAMassOutOfAllProportionAreThoseOfTheRestOrRefused)
{
  const Folder folder("masses");
  const auto   with = [&](const std::string &mass)
  {
    return gestell("modes " + scene("press_minimal.toml") + folder.option() + "--set 'parameters.m3=\"" + mass +
                   " kg\"'");
  };
  for (const std::string mass :
       {"1e-308", "1e-150", "1e-20", "1e-6"}) // a slide without mass; 0.0074 Hz: on its springs
  {
    const Answer without = with(mass);
    EXPECT_EQ(without.exit_code, 0) << without.text;
    for (const std::string frequency : {"0.0074176979", "11.654848", "21.486765", "122.98025"})
      EXPECT_TRUE(without.says(frequency)) << mass << without.text;
  }
  for (const std::string mass : {"1e100", "1e250"}) // a slide at rest
  {
    const Answer held = with(mass);
    EXPECT_EQ(held.exit_code, 0) << held.text;
    for (const std::string frequency : {"0.78549522", "12.376443", "38.752354", "128.63746"})
      EXPECT_TRUE(held.says(frequency)) << mass << held.text;
  }
  expect_answer(with("1e308"), 2, {"mass of coordinate slide is not finite"});
}

TEST(Program, ModesAlongACoordinateLeaveTablesAndCharts)
{
  const Folder folder("along");
  const Answer answer =
      gestell("modes " + scene("press_minimal.toml") + folder.option() + "--along crank --positions 5");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  const std::string table = read(folder.results() / "modes_along.csv");
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "crank.angle [rad],line,frequency [Hz],damped frequency [Hz],damping ratio,mac,configuration,growth [1/s]");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 5 * 5);
  EXPECT_NE(read(folder.results() / "report.html").find("<section id=\"along\">"), std::string::npos);
  EXPECT_NE(read(folder.results() / "summary.json").find("\"order_meetings\""), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder.results() / "charts" / "modes-along.svg"));
  expect_answer(gestell("modes " + scene("press_minimal.toml") + folder.option() + "--along cranc"), 2,
                {"did you mean 'crank'"});
}

TEST(Program, EveryCommandHelpsWithAnExample)
{
  for (const char *command : {"run", "modes", "reduce", "mesh", "check"})
  {
    expect_answer(gestell(std::string(command) + " --help"), 0, {std::string("gestell ") + command + " "});
  }
  EXPECT_TRUE(gestell("--version").says("gestell "));
}

TEST(Program, LengthsOnTheCommandLineTakeUnitsAndSayWhatIsWrong)
{
  for (const char *wrong : {"3kg", "0", "x", "-1"})
  {
    expect_answer(gestell("mesh no_such.step --size=" + std::string(wrong)), 2, {"--size: "});
  }
  const Answer right = gestell("mesh no_such.step --size='80 mm'");
  EXPECT_EQ(right.exit_code, 2);
  EXPECT_FALSE(right.says("--size")) << right.text;
}

// A limit of the process counts as the memory that there is.
TEST(Program, MoreMemoryThanThereIsIsReportedWithWhatHelps)
{
  const Folder folder("memory"); // 60 GB of history and pictures
  const Answer answer =
      shell("ulimit -v 2000000; '" GESTELL_BINARY_DIR "/bin/gestell' run " + scene("press_minimal.toml") +
            folder.option() + "--set run.step=1e-9 --set output.allow_large=true");
  expect_answer(answer, 2, {"would take ", " of memory; available are 1.", "output.step"});
}

/// The text behind "name": in the object that `of` opens.
std::string member(const std::string &json, const std::string &of, const std::string &name)
{
  const auto        object = json.find("\n  \"" + of + "\": {");
  const std::string key    = "\n    \"" + name + "\": ";
  const auto        begin  = json.find(key, object) + key.size();
  return object == std::string::npos ? "no " + of : json.substr(begin, json.find_first_of("\n", begin) - begin);
}

TEST(Program, SummaryReportsWhatWasAskedAndWhatWasRun)
{
  const Folder folder("asked");
  ASSERT_EQ(gestell("run " + scene("press_minimal.toml") + folder.option() +
                    "--set run.end=0.25 --set run.step='\"0.25 ms\"'")
                .exit_code,
            0);
  const std::string json = read(folder.results() / "summary.json");
  EXPECT_NE(member(json, "asked", "file").find("press_minimal.toml\","), std::string::npos);
  EXPECT_NE(json.find("\"set\": [\n      \"run.end=0.25\",\n      \"run.step=\\\"0.25 ms\\\"\"\n    ]"),
            std::string::npos);
  EXPECT_EQ(member(json, "asked", "method"), "\"BDF 2\",");
  EXPECT_EQ(member(json, "asked", "tolerance"), "null,");
  EXPECT_EQ(member(json, "asked", "step"), "0.00025,");
  EXPECT_EQ(member(json, "asked", "end"), "0.25,");
  EXPECT_EQ(member(json, "asked", "events"), "true");
  EXPECT_EQ(member(json, "outcome", "end"), "0.25,");
  EXPECT_EQ(member(json, "outcome", "complete"), "true,");
  EXPECT_EQ(member(json, "outcome", "failure"), "null");
  EXPECT_NE(json.find("\n  \"commit\": "), std::string::npos);
}

TEST(Program, WrongInputLosesNoEarlierResult)
{
  const Folder folder("keep");
  ASSERT_EQ(gestell("run " + scene("press_minimal.toml") + folder.option() + "--set run.end=0.01").exit_code, 0);
  const std::string before = read(folder.results() / "summary.json");
  ASSERT_EQ(gestell("run " + scene("press_minimal.toml") + folder.option() + "--set run.step=0").exit_code, 2);
  EXPECT_EQ(read(folder.results() / "summary.json"), before);
}

TEST(Program, ModesBesideARunLeaveTheRun)
{
  const Folder folder("beside");
  ASSERT_EQ(gestell("run " + scene("press_minimal.toml") + folder.option() + "--set run.end=0.01").exit_code, 0);
  const std::string before = read(folder.results() / "summary.json");
  ASSERT_EQ(gestell("modes " + scene("press_minimal.toml") + folder.option()).exit_code, 0);
  EXPECT_EQ(read(folder.results() / "summary.json"), before);
  EXPECT_TRUE(std::filesystem::exists(folder.results() / "history.csv"));
}

TEST(Program, InterruptedRunSavesWhatItHas)
{
  const Folder folder("interrupted");
  const Answer answer =
      shell("timeout -s INT 1 '" GESTELL_BINARY_DIR "/bin/gestell' run " + scene("press_minimal.toml") +
            folder.option() + "--set run.end=100 --set output.step=0.01; echo code $?");
  // timeout itself answers 124 when it had to send the signal
  EXPECT_TRUE(answer.says("code 124")) << answer.text;
  const std::string summary = read(folder.results() / "summary.json");
  EXPECT_NE(summary.find("\"steps\""), std::string::npos);
}

TEST(Program, StartOfABodyThatIsUnconstrainedNamesIt)
{
  const Folder      folder("falling");
  const std::string falling = folder.file(
      "falling.toml", "name = 'falling'\ngravity = [0, 0, -9.81]\n" +
                          slider_body("block", "10 kg", "[0, 0, -1]", {{"guide", "ground"}}) +
                          element("rubbing", "friction",
                                  {{"from", "block"}, {"to", "ground"}, {"force", "200 N"}, {"speed", "1 mm/s"}}) +
                          start("rule = 'steady'") + steps("1 ms", "1 s") + signals("x = 'block.displacement'"));
  expect_answer(gestell("run " + falling + folder.option()), 2, {"unconstrained DOF block"});
  EXPECT_FALSE(std::filesystem::exists(folder.results()));
}

// The friction of the guide makes 1.5 times the force that causes it: none is right.
TEST(Program, WhatDoesNotStartIsFoundByCheckAndLeavesASummary)
{
  const Folder      folder("jammed");
  const std::string jammed = folder.file(
      "jammed.toml",
      "name = 'jammed'\n" + planar_body("carriage", "3 kg", "1 kg m^2", "[0, 0, 0]") +
          joint("rail", "prismatic", "ground", "carriage", "[0, 0, '-0.6 m']",
                {{"axis", "[1, 0, 0]"}, {"friction", "{ coefficient = 0.25, length = '0.2 m' }"}}) +
          element("moment", "force", {{"from", "carriage"}, {"about", "[0, 1, 0]"}, {"constant", "2 N m"}}) +
          start("v = { 'carriage.ux' = 1 }") + steps("1 ms", "0.1 s") + signals("v = 'carriage.vx'"));
  expect_answer(gestell("check " + jammed), 2, {"no initial state"});
  expect_answer(gestell("run " + jammed + folder.option()), 3, {"\"rail\""});
  EXPECT_NE(read(folder.results() / "summary.json").find("no initial state"), std::string::npos);
}

TEST(Program, FailedNewtonKeepsWhatWasComputedAndSaysWhere)
{
  // A cubic spring that softens without bound has no solution beyond a displacement: the crown falls through.
  const Folder      folder("failed");
  const std::string softening =
      folder.file("softening.toml", R"(name = "softening"
gravity = [0, 0, -9.81]
[frame]
mass      = [["100 kg"]]
damping   = [[0]]
stiffness = [["1 kN/m"]]
[frame.interface.top]
rows = { "-uz" = 1 }
)" +
                                        element("spring", "cubic spring",
                                                {{"from", "frame.top"},
                                                 {"to", "ground"},
                                                 {"direction", "[0, 0, -1]"},
                                                 {"stiffness", "0 N/m"},
                                                 {"cubic", "-1e9"}}) +
                                        steps("1 ms", "1 s") + signals("x = '-frame.top.uz'"));
  expect_answer(gestell("run " + softening + folder.option()), 3, {"t = ", "residual", "frame.top.uz"});
  EXPECT_GT(read(folder.results() / "history.csv").size(), 200u);
  const std::string summary = read(folder.results() / "summary.json");
  EXPECT_EQ(member(summary, "outcome", "complete"), "false,");
  EXPECT_NE(member(summary, "outcome", "failure").find("t = "), std::string::npos);
  EXPECT_LT(std::stod(member(summary, "outcome", "end")), 1.);
  EXPECT_EQ(member(summary, "asked", "end"), "1.0,");
}

} // namespace
} // namespace gestell::tests

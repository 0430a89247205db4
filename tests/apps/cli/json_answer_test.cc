// With --json a command writes one document to standard output, and nothing else: the numbers of its text, its files
// and its errors.

#include "tests/support/program.h"
#include "tests/support/test.h"

#include <nlohmann/json.hpp>

namespace gestell::tests
{
namespace
{

using Json = nlohmann::json;

/// Standard output alone; the document must be all of it.
Json document(const std::string &arguments, int exit_code = 0)
{
  const Folder      folder("json");
  const std::string out = (folder / "out.json").string();
  const Answer      answer =
      shell("( GESTELL_CACHE='" GESTELL_BINARY_DIR "/tests/cache' '" GESTELL_BINARY_DIR "/bin/gestell' " + arguments +
            " --json >'" + out + "' 2>/dev/null )");
  EXPECT_EQ(answer.exit_code, exit_code) << answer.text;
  const Json json = Json::parse(read(out), nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << read(out);
  EXPECT_EQ(json.value("exit_code", -1), exit_code);
  return json;
}

} // namespace

TEST(JsonAnswer, OfARunIsItsSummary)
{
  const Folder folder("json_run");
  const Json   json    = document("run " + scene("press_minimal.toml") + folder.option());
  const Json   summary = Json::parse(read(folder.results() / "summary.json"));
  EXPECT_EQ(json["command"], "run");
  EXPECT_EQ(json["answer"]["signals"], summary["signals"]);
  EXPECT_EQ(json["answer"]["signals"]["F_P"]["unit"], "N");
  EXPECT_EQ(json["answer"]["events"], summary["events"]);
  EXPECT_TRUE(json["text"].is_array());
}

TEST(JsonAnswer, HoldsTheLinesOfTheText)
{
  const std::string press = scene("press_minimal.toml");
  const Answer      text  = gestell("check " + press);
  const Json        json  = document("check " + press);
  std::string       lines;
  for (const Json &line : json["text"])
    lines += line.get<std::string>() + '\n';
  EXPECT_EQ(lines, text.text);
  EXPECT_EQ(json["answer"]["bodies"], Json({"flywheel", "crank", "slide"}));
  EXPECT_DOUBLE_EQ(json["answer"]["run"]["step_s"], 1e-5);
}

TEST(JsonAnswer, OfWrongInputGivesLocationValueRequirementAndRemedy)
{
  const std::string press = scene("press_minimal.toml");
  const Json        error = document("check " + press + " --set 'run.step=0'", 2)["error"];
  EXPECT_EQ(error["exit_code"], 2);
  EXPECT_EQ(error["value"], "0");
  EXPECT_EQ(error["needed"], "a time above zero such as \"10 us\"");
  const Folder folder("json_error");
  const Json   of_file = document(
        "check " + folder.file("scene.toml", "[body.slide]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = \"3 m\"\n"),
        2)["error"];
  EXPECT_EQ(of_file["place"]["line"], 4);
  EXPECT_EQ(of_file["key"], "body.slide.mass");
  const Json line = document("check", 2)["error"];
  EXPECT_NE(line["message"].get<std::string>().find("SCENE is required"), std::string::npos);
  EXPECT_EQ(line["way_out"], "gestell check --help lists its arguments");
}

/// An end by a switch that is to end the run, and one where a law has no value: both with their error and as many
/// findings as warnings and errors.
TEST(JsonAnswer, OfARunThatEndsEarlyReportsWhy)
{
  const std::string slide = "[body.slide]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = 1\n"
                            "[start]\nv = { slide = 1 }\n[run]\nstep = \"1 ms\"\nend = \"0.1 s\"\n"
                            "[output.signals]\nx = \"slide.displacement\"\n";
  const std::string far   = "[switch.far]\nwhen = \"slide.displacement\"\nabove = \"20 mm\"\nends = \"enough\"\n";
  const std::string law   = "[element.law]\ntype = \"formula force\"\nfrom = \"slide\"\n"
                            "force = \"1 N*sqrt(1 - t/(50 ms))\"\n";
  const Folder      folder("json_end");
  const auto        ended = [&](const std::string &more)
  {
    const Json json = document("run " + folder.file("scene.toml", slide + more) + folder.option(), 3);
    EXPECT_EQ(json["answer"]["findings"].size(), json["warnings"].size() + 1);
    return json;
  };
  const Json by_switch = ended(far);
  EXPECT_EQ(by_switch["error"]["message"].get<std::string>().find("a switch ended the run: at t = 0.02 s, enough"), 0u);
  EXPECT_FALSE(by_switch["error"].contains("key"));
  EXPECT_EQ(by_switch["answer"]["findings"][0]["id"], "ended-by-switch");
  EXPECT_EQ(by_switch["answer"]["findings"][0]["place"], "far");
  const Json        by_law  = ended(law);
  const std::string message = by_law["error"]["message"];
  EXPECT_EQ(message.find("the computation failed: "), 0u) << message;
  EXPECT_NE(message.find("\"law\""), std::string::npos) << message;
  EXPECT_EQ(by_law["answer"]["findings"][0]["id"], "law-without-value");
  EXPECT_EQ(by_law["answer"]["findings"][0]["place"], "law");
}

TEST(JsonAnswer, OfAMessageOfAnyLengthIsReported)
{
  const Json of_name = document("check 'x:99999999999999999999: y.toml'", 2);
  EXPECT_NE(of_name["error"].dump().find("y.toml"), std::string::npos) << of_name.dump();
  const Json of_method =
      document("check " + scene("press_minimal.toml") + " --set run.method=" + std::string(100000, 'a'), 2);
  EXPECT_FALSE(of_method["error"].empty());
}

TEST(JsonAnswer, IsGivenByEveryCommandThatComputes)
{
  const Folder      folder("json_all");
  const std::string press = scene("press_minimal.toml") + folder.option();
  EXPECT_TRUE(document("modes " + press)["answer"]["frequencies_hz"].is_object() ||
              document("modes " + press)["answer"]["frequencies_hz"].is_array());
  EXPECT_FALSE(document("frf " + press + " --from frame.crown.uz --to frame.crown.uz")["answer"].is_null());
  const Json stability = document("stability " + press)["answer"];
  EXPECT_EQ(stability["unstable_intervals"][0]["method"].is_string(), true);
  EXPECT_GT(stability["modes"].size(), 3u);
  EXPECT_GT(stability["methods"].size(), 3u);
  EXPECT_FALSE(document("stability --quiet -o '" + folder.results().string() + "'")["text"].empty());
  const Json list = document("reduce --list");
  EXPECT_TRUE(list["answer"]["frames"].is_array());
  EXPECT_NE(list["text"][0].get<std::string>().find(": " + std::to_string(list["answer"]["frames"].size()) + " file"),
            std::string::npos);
}

TEST(JsonAnswer, OfAStudyHasTheRowsOfItsRuns)
{
  const Folder      folder("json_study");
  const std::string study  = "[scene]\nfile = '" GESTELL_SOURCE_DIR "/apps/scenes/press_minimal.toml'\n"
                             "[variables.c_P]\nfrom = '720 kN/mm'\nto = '1080 kN/mm'\n"
                             "[outputs]\nF = 'signals.F_P.max'\n"
                             "[design]\ntype = 'Sobol'\nruns = 4\n";
  const Json        answer = document("study " + folder.file("study.toml", study) + folder.option())["answer"];
  EXPECT_EQ(answer["made"], 4);
  EXPECT_EQ(answer["units"]["F"], "N");
  for (const Json &run : answer["runs"])
  {
    EXPECT_EQ(run["status"], "done");
    EXPECT_GT(run["outputs"]["F"], 5e5);
    EXPECT_GE(run["levels"]["c_P"], 720.);
    EXPECT_LE(run["levels"]["c_P"], 1080.);
  }
}

} // namespace gestell::tests

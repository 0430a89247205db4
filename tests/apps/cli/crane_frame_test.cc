// The mobile crane on its chassis from CAD, through the program: rigid it is the planar reference, elastic the planar
// crane on springs; with its boom to the side it weighs more on one side.

#include "tests/support/csv_table.h"
#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

const std::string reference = std::string(GESTELL_SOURCE_DIR) + "/tests/reference/crane/";

/// Runs a scene; what it says and its summary.
struct CraneRun
{
  CraneRun(const std::string &file, const std::string &more, int exit_code = 0) : folder("crane_frame")
  {
    answer = gestell("run " + scene(file) + folder.option() + more);
    EXPECT_EQ(answer.exit_code, exit_code) << answer.text;
    summary = read(folder.results() / "summary.json");
  }

  double signal(const std::string &name, const std::string &value) const
  {
    return json_number(summary, {"signals", name, value});
  }
  /// Of the n-th event of that kind and object.
  double event(const std::string &name, const std::string &kind, int n = 0) const
  {
    const std::string events = summary.substr(summary.find("\"events\": ["));
    std::size_t       at     = 0;
    for (int found = 0;; at += 8)
    {
      at                     = events.find("\"kind\": \"", at);
      const std::size_t from = events.rfind('{', at), to = events.find('}', at);
      if (at == std::string::npos)
        return std::nan("");
      const std::string one = events.substr(from, to - from);
      if (one.find("\"" + name + "\"") != std::string::npos && one.find("\"" + kind + "\"") != std::string::npos &&
          found++ == n)
        return json_number(one, {"t"});
    }
  }

  Folder      folder;
  Answer      answer;
  std::string summary;
};

// A thousand times as stiff, tetrahedra of any size will do.
const std::string rigid = " --set material.stiff='{E=\"210e12 Pa\", nu=0.3, rho=\"7850 kg/m^3\"}'"
                          " --set frame.material=stiff --set frame.mesh='{size=\"150 mm\"}' --set reduction.modes=0 ";

// The frame rotates by small angles: theta = 0.024 rad at most.  Lengths on it are too long by theta^2/2 = 3e-4, its
// weights keep their lever arms but for the moment M_lean.  So forces and times err by some 1e-3: the limiter, to which
// Q4 rises by 25 kN/s, by 2 ms for 50 N of 288 kN; all that follows by as much more.
TEST(CraneFrame, MadeRigidIsThePlanarReference)
{
  const CraneRun run("crane.toml", rigid);
  const CsvTable events(reference + "events.csv"), peaks(reference + "peaks.csv");
  const std::map<std::string, std::pair<std::string, std::string>> words = {
      {"trigger_brake_start", {"limiter", "switch"}},
      {"brake_end", {"cylinder", "braking_ends"}},
      {"lift_off_rear", {"rear left", "lift_off"}},
      {"touch_down_rear", {"rear left", "touch_down"}}};
  std::map<std::string, int> seen;
  for (int i = 0; i < events.rows(); ++i)
    if (const std::string event = events.text(i, "event"); events.text(i, "wheel_model") == "unilateral")
      EXPECT_NEAR(run.event(words.at(event).first, words.at(event).second, seen[event]++), events.number(i, "t"), 4e-3)
          << event;
  for (int i = 0; i < peaks.rows(); ++i)
  {
    if (peaks.text(i, "wheel_model") != "unilateral")
      continue;
    const double value = peaks.number(i, "value");
    const auto   found = [&](const std::string &signal) { return run.signal(signal, peaks.text(i, "kind")); };
    if (const std::string quantity = peaks.text(i, "quantity"); quantity == "Q4")
      EXPECT_NEAR(found("Q4"), value, 5e-3 * value);
    else if (quantity == "F_v")
      EXPECT_NEAR(found("F_vl") + found("F_vr"), value, 5e-3 * value);
    else if (quantity == "q2")
      EXPECT_NEAR(found("q2"), value, 5e-3 * std::abs(value));
    else if (quantity == "x_L" || quantity == "z_L")
      EXPECT_NEAR(found(quantity), value, 2e-3);
  }
}

TEST(CraneFrame, MadeRigidRingsAsTheReference)
{
  const Folder folder("crane_modes");
  const Answer answer = gestell("modes " + scene("crane.toml") + folder.option() + rigid +
                                " --set joint.cylinder.length='\"2.752989795 m\"'");
  ASSERT_EQ(answer.exit_code, 0) << answer.text;
  const CsvTable      modes((folder.results() / "modes.csv").string());
  std::vector<double> found;
  for (int i = 0; i < modes.rows(); ++i)
    if (modes.text(i, "kind") == "coupled")
      found.push_back(modes.number(i, "frequency [Hz]"));
  for (const double expected : {0.404110925659, 1.245383386648, 2.604609373460})
  {
    double least = 1.;
    for (const double f : found)
      least = std::min(least, std::abs(f / expected - 1.));
    EXPECT_LT(least, 2e-3) << expected;
  }
}

// The springs of crane_minimal_elastic.toml are those of the frame but for what pin and foot move against each other,
// 0.5 of 3 mm, and the masses on the seats move with the axles there.
TEST(CraneFrame, RingsAsThePlanarCraneOnItsSprings)
{
  const CraneRun run("crane.toml", ""), planar("crane_minimal_elastic.toml", "--set run.step='\"0.5 ms\"'");
  EXPECT_NEAR(run.event("limiter", "switch"), planar.event("limiter", "switch"), 0.01);
  EXPECT_NEAR(run.signal("Q4", "max"), planar.signal("Q4", "max"), 0.02 * planar.signal("Q4", "max"));
  for (const char *stage :
       {"luffing", "braking", "ringing", "Ringing", "Wheel lift-off", "rear left", "machine linearised at rest"})
    EXPECT_TRUE(run.answer.says(stage)) << run.answer.text;
  EXPECT_NEAR(run.signal("F_hl", "max"), run.signal("F_hr", "max"), 1e-6 * run.signal("F_hl", "max"));
  EXPECT_LT(json_number(run.summary, {"energy", "residual"}), 1e-4 * json_number(run.summary, {"energy", "exchanged"}));
}

TEST(CraneFrame, WeighsMoreOnTheSideOfItsBoom)
{
  const CraneRun run("crane_slewed.toml",
                     "--set parameters.v_cylinder='\"0 m/s\"' --set switch.limiter.above='\"1 MN\"' "
                     "--set run.end='\"20 ms\"' --set output.stages.borders='[\"limiter\"]' "
                     "--set output.stages.names='[\"all\", \"none\"]'",
                     3); // the limiter is never reached
  double         sum = 0.;
  for (const char *wheel : {"F_hl", "F_hr", "F_vl", "F_vr"})
    sum += run.signal(wheel, "final");
  EXPECT_NEAR(sum, 24400. * 9.81, 1e-4 * sum);
  EXPECT_GT(run.signal("F_vl", "final"), 1.3 * run.signal("F_vr", "final"));
  EXPECT_TRUE(run.answer.says("did not reach the stage boundary 'limiter'"));
}

TEST(CraneFrame, TipsWhereItReachesTooFar)
{
  const CraneRun run("crane.toml", "--set parameters.F_limit='\"330 kN\"'", 3);
  EXPECT_TRUE(run.answer.says("the crane tips over its front axle"));
}

} // namespace
} // namespace gestell::tests

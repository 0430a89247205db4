// An analysis that takes part in runs: what it gets, what requests it, and its outcome.

#include "apps/analysis/analyses.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::AnalysisOutcome;
using apps::Result;
using apps::Session;

const std::string swinging = "name = 'swinging'\n" + slider_body("mass", "2 kg", "[1, 0, 0]") +
                             element("spring", "spring-damper", {{"from", "mass"}, {"stiffness", "800 N/m"}}) +
                             start("q = { mass = '10 mm' }") +
                             table("run", {{"method", "bdf"}, {"tolerance", "1e-8"}, {"end", "0.5 s"}}) +
                             "[output.signals]\nx = 'mass.displacement'\n";

/// Requested by [output.stages].
class Probe : public apps::Analysis
{
public:
  bool        requested(const apps::Scene &scene) const override { return scene.stages.given(); }
  std::string needs_trajectory() const override { return "--probe"; }
  void        before_motion(apps::RunInProgress &run) override { had_run = run.result.run.has_value(); }
  void        after_motion(apps::RunInProgress &run) override
  {
    nodes.clear();
    for (const coupling::SmoothPiece &piece : run.trajectory.pieces())
      nodes.insert(nodes.end(), piece.nodes.begin(), piece.nodes.end());
    run.result.run->failure = failure;
  }
  AnalysisOutcome compute(Session &, Result &) const override { return AnalysisOutcome::interrupted; }

  bool                              had_run = true;
  std::string                       failure;
  std::vector<coupling::MotionNode> nodes;
};

TEST(RunPart, HasTheMotionOfItsCommandAndFailsWithTheRun)
{
  const test::SceneFolder   folder;
  const std::string         path = folder.write("scene.toml", test::quoted(swinging));
  const apps::AnalysisEntry entry{"probe", "is a command, too", {}, {}, {}, {}, "run"};
  Probe                     probe;
  AnalysisOutcome           outcome = AnalysisOutcome::done;
  Session                   first(path), second(path);
  const Result              result = apps::computed(entry, probe, first, outcome);
  EXPECT_EQ(outcome, AnalysisOutcome::interrupted);
  EXPECT_EQ(result.command, "probe");
  EXPECT_FALSE(probe.had_run);
  ASSERT_FALSE(probe.nodes.empty());
  EXPECT_DOUBLE_EQ(probe.nodes.front().q[0], 0.01);
  EXPECT_DOUBLE_EQ(probe.nodes.back().t, 0.5);
  probe.failure = "the probe fails";
  apps::computed(entry, probe, second, outcome);
  EXPECT_EQ(outcome, AnalysisOutcome::failed);
}

TEST(RunPart, IsRequestedByATableOfTheScene)
{
  const test::SceneFolder folder;
  const std::string       path = folder.write("scene.toml", test::quoted(swinging));
  Session                 without(path), with(path, {"output.stages={borders=[\"never\"]}"});
  for (Session *session : {&without, &with})
  {
    const auto           probe = std::make_shared<Probe>();
    const apps::Analyses all{probe};
    const bool           is     = session == &with;
    Result               result = apps::run_with(all, *session);
    EXPECT_EQ(apps::needs_trajectory(all, session->scene()), is ? "--probe" : "");
    EXPECT_EQ(probe->nodes.empty(), !is);
    EXPECT_EQ(apps::add_answers(all, *session, result), is ? AnalysisOutcome::interrupted : AnalysisOutcome::done);
  }
}

} // namespace
} // namespace gestell::tests

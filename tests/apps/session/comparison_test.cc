// Where energies of modes lie, and scenes beside each other: against the reference of the press.

#include "apps/analysis/comparison/mode_comparison.h"
#include "apps/analysis/comparison/run_comparison.h"
#include "apps/analysis/comparison/scene_comparison.h"
#include "apps/session/session.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_run.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::Session;

double strain_share(const coupling::EnergyShares &shares, const std::string &spring, int mode)
{
  const auto found = std::find(shares.springs.begin(), shares.springs.end(), spring);
  return found == shares.springs.end() ? 0. : shares.strain(found - shares.springs.begin(), mode);
}

// modes.csv of the reference, 20 degrees before bottom dead centre: c_T, c_P, c_G + c_F.
TEST(EnergyShares, OfThePressAreThoseOfTheReference)
{
  const apps::Result result = Session(shipped("press_minimal.toml")).modes();
  ASSERT_TRUE(result.energy_shares);
  const auto  &shares        = *result.energy_shares;
  const double expected[][3] = {
      {0.9985800144622903, 0.0002448658625610168, 9.760552256425609e-05 + 0.0010640435990911118},
      {0.0012347374940570237, 0.007918999871551024, 0.033078906180601456 + 0.9577672721344265},
      {0.000163910240536552, 0.7535392818916129, 0.21862822575264856 + 0.027652223355180975},
      {8.384538608081514e-06, 0.23827464637147, 0.7481952625434314 + 0.013516460905496313}};
  for (int j = 1; j < 5; ++j)
  {
    EXPECT_NEAR(strain_share(shares, "clutch", j), expected[j - 1][0], 2e-5); // the reference leaves out c_CB
    EXPECT_NEAR(strain_share(shares, "rod", j), expected[j - 1][1], 2e-5);
    EXPECT_NEAR(strain_share(shares, "frame", j), expected[j - 1][2], 2e-5);
  }
}

// Strain: v^T K v = omega^2; without forces that turn with the motion the springs alone make it up.
TEST(EnergyShares, SumUpToOne)
{
  for (const char *file : {"press_minimal.toml", "crane_minimal.toml"})
  {
    const apps::Result result = Session(shipped(file)).modes();
    const auto        &shares = *result.energy_shares;
    for (Eigen::Index j = 0; j < shares.kinetic.cols(); ++j)
    {
      EXPECT_NEAR(shares.kinetic.col(j).sum(), 1., 1e-10);
      if (result.coupled_modes[std::size_t(j)].frequency_hz > 0.)
      {
        EXPECT_NEAR(shares.strain.col(j).sum(), 1., 1e-5); // springs below 1e-6 are left out
      }
    }
  }
  const auto press = *Session(shipped("press_minimal.toml")).modes().energy_shares;
  EXPECT_EQ(std::count(press.springs.begin(), press.springs.end(), "turning forces"), 0);
}

const apps::ComparedShapes *shapes_of(const apps::Result &result)
{
  return apps::answer_in<apps::ComparedShapes>(result.answers);
}

const apps::ComparedRun *run_of(const apps::Result &result)
{
  return apps::answer_in<apps::ComparedRun>(result.answers);
}

apps::Result compared(const std::string &a, const std::string &b, const std::vector<std::string> &overrides = {})
{
  Session      session(a, overrides), other(b);
  apps::Result result = session.modes();
  add_compared_modes(session, result, other);
  return result;
}

TEST(ComparedModes, OfASceneWithItselfAreTheIdentity)
{
  const std::string  press  = shipped("press_minimal.toml");
  const apps::Result result = compared(press, press);
  const auto        *shapes = shapes_of(result);
  ASSERT_TRUE(shapes);
  EXPECT_EQ(shapes->measures.size(), 5u); // its five coordinates
  EXPECT_LT((shapes->match.mac - Eigen::MatrixXd::Identity(5, 5)).cwiseAbs().maxCoeff(), 1e-9);
}

// With rigid columns crown and table move as one: f5 is gone to high frequencies, the others stay what they are.
TEST(ComparedModes, OfARigidFrameFindTheirPartners)
{
  const apps::Result result =
      compared(shipped("press_minimal.toml"), shipped("press_minimal.toml"), {"parameters.c_G=\"3.2e6 kN/mm\""});
  const auto &shapes = *shapes_of(result);
  ASSERT_GE(shapes.match.pairs.size(), 4u);
  for (int j = 0; j < 4; ++j)
  {
    EXPECT_EQ(shapes.match.pairs[std::size_t(j)].b, j);
    EXPECT_GT(shapes.match.pairs[std::size_t(j)].assurance, 0.85); // f4: the crown no longer rests
  }
  EXPECT_GT(shapes.a.modes[3].frequency_hz, shapes.b.modes[3].frequency_hz); // stiffer
}

// The light variant of the reference: F_P_min from -601.647 to -501.089 kN.
TEST(ComparedRun, OfTheLightVariantReportsItsGain)
{
  Session session(shipped("press_minimal.toml")), other(shipped("press_minimal_light.toml"));
  require_comparable_runs(session, other);
  apps::Result result = session.run();
  add_compared_run(session, result, other);
  const auto *compared = run_of(result);
  ASSERT_TRUE(compared && shapes_of(result));
  const auto shared = apps::shared_signals(*result.run, compared->run);
  EXPECT_EQ(shared.size(), result.run->signals.size());
  EXPECT_NEAR(compared->run.signals[shared[0].b].min / result.run->signals[shared[0].a].min, 501.089 / 601.647, 1e-4);
}

/// A slider of that name on a spring.
std::string slider_named(const std::string &name)
{
  return "name = \"" + name + "\"\n[body." + name +
         "]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = \"1 kg\"\n[element." + name +
         "_rest]\ntype = \"spring-damper\"\nfrom = \"" + name +
         "\"\ndirection = [1, 0, 0]\nstiffness = \"10 N/mm\"\n[start]\nrule = \"given\"\nq = { " + name +
         " = \"1 mm\" }\n[run]\nmethod = \"newmark\"\nstep = \"1 ms\"\nend = \"0.1 s\"\n[output.signals]\nx = \"" +
         name + ".displacement\"\n";
}

// Their signals may be compared, their modes not; asked for these alone, it is an error.
TEST(ComparedRun, OfMachinesWithoutACommonMotionHasNoModes)
{
  const test::SceneFolder folder;
  Session session(folder.write("a.toml", slider_named("a"))), other(folder.write("b.toml", slider_named("b")));
  require_comparable_runs(session, other);
  apps::Result result = session.run();
  add_compared_run(session, result, other);
  EXPECT_TRUE(run_of(result));
  EXPECT_FALSE(shapes_of(result));
  EXPECT_THAT(refusal([&] { add_compared_modes(session, result, other); }),
              ::testing::HasSubstr("have no body, interface or element of the same name"));
}

} // namespace
} // namespace gestell::tests

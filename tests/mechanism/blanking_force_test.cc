#include "mechanism/elements/blanking_force.h"
#include "tests/support/element_probe.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

const BlankingForce::Parameters press{0.004, 0.8, 3.2e8, 0.35, 8., 0.25, 0.08, 9e9, 0.152};

Probe at(double z, double rate = 0.1)
{
  return {0., Eigen::VectorXd::Constant(1, press.contact_at + z), Eigen::VectorXd::Constant(1, rate),
          Eigen::VectorXd::Zero(1)};
}

double resistance(const BlankingForce &sheet, double z, const Eigen::VectorXd &history)
{
  return -force(sheet, at(z), history.data())[0];
}

Eigen::VectorXd fresh(const BlankingForce &sheet)
{
  return started(sheet, at(-0.01));
}

TEST(BlankingForce, VirginCurveIsContinuousAndSmoothWhereItsBranchesMeet)
{
  const BlankingForce   sheet(press);
  const Eigen::VectorXd history = fresh(sheet);
  for (const double edge : {0.0014, 0.0024, 0.004})
  {
    const double d = 1e-9;
    EXPECT_NEAR(resistance(sheet, edge - d, history), resistance(sheet, edge + d, history), 1e-2); // slope < 1.5e9 N/m
    const double slope_before = resistance(sheet, edge - d, history) - resistance(sheet, edge - 2. * d, history);
    EXPECT_NEAR(slope_before / d, 0., 3e4); // all meet with horizontal tangents; F'' <= 6e12 N/m^2
  }
  EXPECT_NEAR(resistance(sheet, 0.0014, history), sheet.peak_force(), 1e-6);
  EXPECT_DOUBLE_EQ(sheet.peak_force(), 3.2e8 * 0.8 * 0.004);
}

TEST(BlankingForce, UnloadsElasticallyAndReloadsOntoTheVirginCurve)
{
  const BlankingForce sheet(press);
  Eigen::VectorXd     history = fresh(sheet);
  sheet.accept(at(5e-4).motion(), history.data());
  const double peak = resistance(sheet, 5e-4, history);
  EXPECT_NEAR(resistance(sheet, 4.9e-4, history), peak - 9e9 * 1e-5, 1e-6);
  EXPECT_EQ(resistance(sheet, 3e-4, history), 0.); // below z_e: the punch is free, it never pulls
  EXPECT_NEAR(resistance(sheet, 5e-4 + 1e-12, history), peak, 1.);
}

TEST(BlankingForce, TrialMotionDoesNotChangeTheHistory)
{
  const BlankingForce   sheet(press);
  const Eigen::VectorXd history = fresh(sheet);
  const Eigen::VectorXd before  = history;
  resistance(sheet, 3e-3, history);
  EXPECT_EQ(history, before);
}

TEST(BlankingForce, SeveredSheetResistsNoMore)
{
  const BlankingForce sheet(press);
  Eigen::VectorXd     history = fresh(sheet);
  sheet.accept(at(0.0041).motion(), history.data());
  for (const double z : {0.001, 0.0039, 0.0041})
    EXPECT_EQ(resistance(sheet, z, history), 0.);
}

TEST(BlankingForce, TellsEveryStageOfTheCut)
{
  const BlankingForce sheet(press);
  Eigen::VectorXd     history = fresh(sheet);
  const auto          take    = [&](int i, double z, double rate)
  {
    const std::string kind = sheet.guards(history.data())[i].kind;
    sheet.transition(i, at(z, rate).motion(), history.data());
    return kind;
  };
  EXPECT_EQ(take(0, 0., 0.1), "tool_contact");
  EXPECT_EQ(take(0, 8e-5, 0.), "tool_unload");
  EXPECT_DOUBLE_EQ(history[0], at(8e-5).u[0] - press.contact_at);
  EXPECT_EQ(take(0, 4e-5, -0.1), "tool_release");
  EXPECT_EQ(take(0, 4e-5, 0.1), "tool_contact");
  EXPECT_EQ(take(1, 8e-5, 0.1), "tool_reload");
  EXPECT_EQ(take(1, 0.0014, 0.1), "tool_force_maximum_passed");
  EXPECT_EQ(take(1, 0.0024, 0.1), "fracture_branch_end");
  EXPECT_EQ(take(1, 0.004, 0.1), "sheet_severed");
  EXPECT_EQ(sheet.n_guards(history.data()), 0);
}

TEST(BlankingForce, LargestPenetrationIsThatOfTheInstant)
{
  constexpr int       largest = 2;
  const BlankingForce sheet(press);
  Eigen::VectorXd     history  = fresh(sheet);
  const auto          reported = [&](double z) { return sheet.quantity(largest, at(z).motion(true), history.data()); };
  sheet.transition(0, at(0.).motion(true), history.data());
  EXPECT_NEAR(reported(5e-4), 5e-4, 1e-15) << "ahead of the last accepted motion";
  sheet.accept(at(5e-4).motion(true), history.data());
  EXPECT_NEAR(reported(4e-4), 5e-4, 1e-15) << "behind it";
  for (const double z : {0.0014, 0.0024, 0.004})
    sheet.transition(1, at(z).motion(true), history.data());
  EXPECT_EQ(reported(0.006), press.thickness) << "a sheet that is severed";
  sheet.accept(at(0.006).motion(true), history.data());
  EXPECT_EQ(reported(0.001), press.thickness);
}

TEST(BlankingForce, NeedsAnUnloadingLineSteeperThanTheRise)
{
  auto wrong              = press;
  wrong.elastic_stiffness = 5e9; // the rise starts with 8 * 1.024e6 / 1.4e-3 = 5.85e9 N/m
  EXPECT_THROW(BlankingForce{wrong}, std::invalid_argument);
  wrong                      = press;
  wrong.fracture_penetration = 0.7;
  EXPECT_THROW(BlankingForce{wrong}, std::invalid_argument);
  wrong           = press;
  wrong.thickness = 0.;
  EXPECT_THROW(BlankingForce{wrong}, std::invalid_argument);
}

} // namespace
} // namespace gestell::tests

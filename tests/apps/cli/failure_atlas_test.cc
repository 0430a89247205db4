// The failure atlas: what the roots foretell is what the integrators do.

#include "apps/atlas/atlas.h"
#include "apps/atlas/trials.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace apps;

using FailureAtlas = ::testing::TestWithParam<AtlasEntry (*)()>;

TEST_P(FailureAtlas, PredictedIsMeasured)
{
  const AtlasEntry entry = GetParam()();
  EXPECT_FALSE(entry.comparisons.empty()) << entry.title;
  for (const AtlasComparison &c : entry.comparisons)
    EXPECT_NEAR(c.measured, c.predicted, c.tolerance) << entry.title << ": " << c.what;
}

INSTANTIATE_TEST_SUITE_P(Entries, FailureAtlas,
                         ::testing::Values(bdf3_on_a_frame, bdf_of_high_order, wilson_below_its_limit, wilson_overshoot,
                                           newmark_outside_its_limits, exact_force_at_contact, hard_contact,
                                           order_at_play, fixed_point_of_forces, drift_of_joints,
                                           first_multiplier_of_a_joint, chatter));

TEST(FailureAtlas, GrowthIsMeasuredForOneRootAndForAPair)
{
  Eigen::VectorXd one(400), pair(400);
  for (int n = 0; n < 400; ++n)
  {
    one[n]  = 3. * std::pow(-1.2, n) + std::pow(0.5, n);
    pair[n] = std::pow(1.05, n) * std::cos(0.7 * n + 0.3) + std::pow(0.6, n);
  }
  EXPECT_NEAR(measured_growth(one), 1.2, 1e-12);
  EXPECT_NEAR(measured_growth(pair), 1.05, 1e-12);
}

TEST(FailureAtlas, DocumentHasEveryEntryAndItsFigures)
{
  const std::vector<AtlasEntry> entries{wilson_overshoot(), fixed_point_of_forces()};
  const std::string             text = atlas_markdown(entries, "figures");
  for (const AtlasEntry &entry : entries)
  {
    EXPECT_NE(text.find("## " + entry.title), std::string::npos);
    for (const auto &figure : entry.figures)
    {
      EXPECT_NE(text.find("(figures/" + figure.name + ".svg)"), std::string::npos);
      EXPECT_EQ(figure.svg.rfind("<svg", 0), 0u);
    }
  }
}

} // namespace
} // namespace gestell::tests

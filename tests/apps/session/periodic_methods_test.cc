// What the methods of `gestell periodic` take, refuse and tell.

#include "tests/apps/session/periodic_scenes.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{

/// An option that the methods at work do not take would do nothing unsaid.
TEST(PeriodicScene, RefusesOptionsThatItsMethodDoesNotTake)
{
  const auto words = [](const std::string &method, const std::function<void(PeriodicRequest &)> &ask)
  {
    PeriodicRequest request{method};
    ask(request);
    return refusal([&] { periodic_of(duffing(0.05, 0.5, 0.3, 1.), request); });
  };
  EXPECT_THAT(words("shooting", [](auto &r) { r.own["harmonics"] = 3; }),
              testing::HasSubstr("--method harmonic-balance"));
  EXPECT_THAT(words("shooting", [](auto &r) { r.own["starts"] = 3; }), testing::HasSubstr("--method minimise"));
  EXPECT_THAT(words("shooting", [](auto &r) { r.own["damping"] = 0.1; }), testing::HasSubstr("--method settling"));
  EXPECT_THAT(words("settling", [](auto &r) { r.own["lead-in"] = 3; }), testing::HasSubstr("--lead-in"));
  EXPECT_THAT(words("shooting", [](auto &r) { r.own["lead-in"] = -1; }), testing::HasSubstr("an integer from 0"));
  EXPECT_THAT(words("shooting", [](auto &r) { r.check = "shooting"; }), testing::HasSubstr("choose another method"));
  EXPECT_THAT(words("harmonic-balance", [](auto &r) { r.own["harmonics"] = 5000; }),
              testing::HasSubstr("at most 3999"));
  EXPECT_THAT(words("averaging", [](auto &r) { r.along = "element.load.constant", r.from = "0 N", r.to = "1 N"; }),
              testing::HasSubstr("--method harmonic-balance --harmonics 1"));
  EXPECT_EQ(words("shooting", [](auto &r) { r.check = "harmonic-balance", r.own["harmonics"] = 9; }), "");
}

TEST(PeriodicScene, OfAMachineThatNothingDrivesHasAFreeSpeed)
{
  const std::string wheel = rotor_body("wheel", "0.6 kg m^2", "[0, 1, 0]") + "[start]\nv = { wheel = 15 }\n";
  EXPECT_THAT(periodic_of(wheel).reason, testing::HasSubstr("its speed is arbitrary: set it by --period"));
}

/// On a motion that a series gives, extremes lie between the samples: of a cosine its amplitude.
TEST(PeriodicScene, ExtremesOfASeriesAreItsOwn)
{
  PeriodicRequest request{"harmonic-balance"};
  request.own["harmonics"]    = 1;
  const PeriodicResult result = periodic_of(duffing(0.05, 0., 1., 1.37), request);
  ASSERT_EQ(result.entries.size(), 1u);
  const double a = 1. / std::hypot(1. - 1.37 * 1.37, 0.1 * 1.37);
  EXPECT_NEAR(result.entries[0].signals[0].max, a, 1e-12 * a);
  EXPECT_NEAR(result.entries[0].signals[0].min, -a, 1e-12 * a);
}

/// Friction that sticks at rest slides in the motion: with 4 R/pi against the load F the amplitude is, in first order
/// and without other damping, sqrt(F^2 - (4 R/pi)^2)/(2 w_0 |w_0 - w|).
TEST(PeriodicScene, AveragingSeesDryFriction)
{
  const double Omega = 0.6, R = 0.2;
  for (const std::string law : {"dry friction", "friction"})
  {
    const std::vector<std::pair<std::string, std::string>> dry         = {{"kinetic_force", number(R)},
                                                                          {"static_force", number(R)}},
                                                           regularised = {{"force", number(R)}, {"speed", "0.0001"}};
    std::vector<std::pair<std::string, std::string>> keys              = law == "friction" ? regularised : dry;
    keys.insert(keys.begin(), {"from", "slide"});
    PeriodicRequest      request{"averaging"};
    const PeriodicResult result =
        periodic_of(slider_body("slide", "1", "[1, 0, 0]") +
                        element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "1"}}) +
                        element("rub", law, keys) + cosine_load("slide", 1., Omega) + test::quoted(output_x),
                    request);
    ASSERT_EQ(result.entries.size(), 1u) << law << result.failure;
    const double first_order = std::sqrt(1. - std::pow(4. * R / M_PI, 2)) / (2. * (1. - Omega));
    EXPECT_NEAR(result.entries[0].signals[0].max, first_order, (law == "friction" ? 1e-6 : 1e-10)) << law;
    EXPECT_TRUE(result.entries[0].solution.stable());
  }
}

/// A mass that friction holds the whole period, on one that swings: the friction is the force of the spring between
/// them from the first instant, also where the start is rounded.
TEST(PeriodicScene, WhatSticksHasItsForceFromTheFirstInstant)
{
  const std::string text =
      slider_body("a", "2", "[1, 0, 0]") + slider_body("b", "1", "[1, 0, 0]") +
      element("sa", "spring-damper", {{"from", "a"}, {"stiffness", "400"}, {"damping", "4"}}) +
      element("sb", "spring-damper", {{"from", "b"}, {"to", "a"}, {"stiffness", "100"}, {"damping", "1"}}) +
      element("rub", "dry friction", {{"from", "b"}, {"kinetic_force", "4"}, {"static_force", "5"}}) +
      cosine_load("a", 8., 3. * M_PI) + test::quoted("[output.signals]\nF = 'rub.force'\nS = 'sb.force'\n");
  const PeriodicResult result = periodic_of(text, {"settling"});
  ASSERT_FALSE(result.entries.empty()) << result.failure;
  const auto &rows = result.entries[0].rows;
  for (std::size_t i = 0; i < rows.size(); i += 3)
    EXPECT_NEAR(std::abs(rows[i + 1]), std::abs(rows[i + 2]), 1e-6) << i / 3;
}

/// A sheet that is broken has no force where it had one before: no mesh of collocation sees that.
TEST(PeriodicScene, CollocationRefusesAnElementThatRemembers)
{
  PeriodicRequest request{"collocation"};
  request.own["lead-in"] = 0;
  expect_refusal([&] { periodic_of(Session(press_minimal), request); }, "sheet has hysteresis");
}

} // namespace gestell::tests

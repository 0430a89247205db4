// What scenes do in the long run, and the pictures of their motions, against what must hold of them.

#include "tests/apps/session/periodic_scenes.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// x'' + b x' + c x + beta x^3 = F cos(Omega t)
std::string cubic_slide(double b, double c, double beta, double F, const std::string &frequency)
{
  return slider_body("slide", "1", "[1, 0, 0]") +
         element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", number(c)}, {"damping", number(b)}}) +
         element("cubic", "cubic spring", {{"from", "slide"}, {"cubic", number(beta)}}) +
         element("load", "force",
                 {{"from", "slide"},
                  {"to", "ground"},
                  {"direction", "[1, 0, 0]"},
                  {"harmonics",
                   "[{ amplitude = '" + number(F) + " N', frequency = '" + frequency + "', phase = '90 deg' }]"}}) +
         test::quoted("[output.signals]\nx = 'slide.displacement'\nv = 'slide.velocity'\nF = 'cubic.force'\n");
}

std::string hertz(double Omega)
{
  return number(Omega / (2. * M_PI)) + " Hz";
}

PeriodicRequest request_by(const std::string &method)
{
  PeriodicRequest request{method};
  if (method == "minimise")
    request.own["starts"] = 4;
  return request;
}

} // namespace

/// All periodic motions are unstable: that there is chaos is the answer, not a failure.
TEST(LongRun, OfUedasOscillatorIsReportedAsChaos)
{
  PeriodicRequest request     = request_by("minimise");
  request.own["starts"]       = 1;
  const PeriodicResult result = periodic_of(cubic_slide(0.05, 0., 1., 7.5, hertz(1.)), request);
  EXPECT_EQ(result.failure, "");
  ASSERT_TRUE(result.long_run);
  const auto &run = *result.long_run;
  EXPECT_EQ(run.motion.kind, "chaotic");
  for (const PeriodicEntry &entry : result.entries)
    EXPECT_FALSE(entry.solution.stable());
  // the section in coordinates and in signals is the same
  ASSERT_EQ(run.rows.size(), 3u * std::size_t(run.motion.periods));
  for (int k = 0; k < run.motion.periods; ++k)
  {
    const double x = run.motion.section(0, k);
    EXPECT_EQ(run.rows[3 * std::size_t(k)], x);
    EXPECT_EQ(run.rows[3 * std::size_t(k) + 1], run.motion.section(1, k));
    EXPECT_NEAR(std::abs(run.rows[3 * std::size_t(k) + 2]), std::abs(x * x * x), 1e-12 * std::abs(x * x * x));
  }
  ASSERT_EQ(run.planes.size(), 1u) << "of x alone the rate is known";
  EXPECT_EQ(run.planes[0].curves[0].rate[7], run.motion.section(1, 7));
}

/// Settling by single periods never ends; the motion of three is found, computed and stable.
TEST(LongRun, FindsTheSubharmonicMotionToWhichAMachineSettles)
{
  const std::string    start  = test::quoted("[start]\nv = { slide = 4 }\n");
  const PeriodicResult result = periodic_of(cubic_slide(0.05, 1., 0.5, 3., hertz(3.3)) + start, request_by("settling"));
  EXPECT_EQ(result.failure, "");
  ASSERT_TRUE(result.long_run);
  EXPECT_EQ(result.long_run->motion.kind, "sub-harmonic");
  ASSERT_EQ(result.entries.size(), 1u);
  EXPECT_EQ(result.entries[0].solution.ratio, 3);
  EXPECT_TRUE(result.entries[0].solution.stable());
  EXPECT_LT(result.entries[0].solution.residual, 1e-10);
  // from then on the section is that motion
  const auto  &section = result.long_run->motion.section;
  Eigen::Index nearest;
  EXPECT_LT((section.row(0).array() - result.entries[0].solution.q[0]).abs().minCoeff(&nearest), 1e-5);
}

/// One unstable motion may be all that was asked for: the way to the rest is told.
TEST(LongRun, IsOfferedWhereTheOnlyMotionIsUnstable)
{
  const PeriodicResult result = periodic_of(cubic_slide(0.05, 0., 1., 7.5, hertz(1.)), request_by("shooting"));
  ASSERT_EQ(result.entries.size(), 1u) << result.failure;
  EXPECT_FALSE(result.long_run);
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_THAT(result.notes[0], testing::HasSubstr("--section 256"));
}

TEST(LongRun, IsReportedWhereItIsAskedFor)
{
  PeriodicRequest request = request_by("shooting");
  EXPECT_FALSE(periodic_of(cubic_slide(0.1, 1., 0., 1., hertz(1.4)), request).long_run);
  request.section             = 80;
  const PeriodicResult result = periodic_of(cubic_slide(0.1, 1., 0., 1., hertz(1.4)), request);
  ASSERT_TRUE(result.long_run);
  EXPECT_EQ(result.long_run->motion.kind, "periodic");
  EXPECT_EQ(result.long_run->motion.section.cols(), 80);
  EXPECT_EQ(result.entries.size(), 1u);
  request.along = "parameters.x";
  request.from = request.to = "1";
  const std::string named   = test::quoted("gravity = [0, 0, 'x']\n[parameters]\nx = 1\n");
  expect_refusal([&] { periodic_of(named + cubic_slide(0.1, 1., 0., 1., hertz(1.4)), request); }, "one solution");
  request.along   = "";
  request.section = 10;
  expect_refusal([&] { periodic_of(cubic_slide(0.1, 1., 0., 1., hertz(1.4)), request); }, "at least 64");
}

/// A motion of three periods is computed a second way as one of three periods, too.
TEST(LongRun, ChecksASubharmonicMotionByItsOwnPeriod)
{
  const std::string start = test::quoted("[start]\nv = { slide = 4 }\n");
  PeriodicRequest   request{"shooting"};
  request.ratio          = 3;
  request.own["lead-in"] = 30;
  request.check          = "harmonic-balance";
  auto result            = periodic_of(cubic_slide(0.05, 1., 0.5, 3., hertz(3.3)) + start, request);
  ASSERT_EQ(result.checks.size(), 1u);
  EXPECT_EQ(result.checks[0].failure, "");
  EXPECT_LT(result.checks[0].distances[0].second, 1e-8);
  request       = request_by("settling");
  request.check = "shooting";
  result        = periodic_of(cubic_slide(0.05, 1., 0.5, 3., hertz(3.3)) + start, request);
  ASSERT_EQ(result.checks.size(), 1u);
  EXPECT_LT(result.checks[0].distances[0].second, 1e-8) << result.checks[0].failure;
}

/// x = a cos(Omega t) is an ellipse in its plane: x^2 + (x'/Omega)^2 = a^2.
TEST(PhasePlane, OfALinearOscillatorIsAnEllipse)
{
  const PeriodicResult result = periodic_of(cubic_slide(0.1, 1., 0., 1., hertz(1.4)), request_by("shooting"));
  const double         a      = 1. / std::hypot(1. - 1.4 * 1.4, 0.1 * 1.4);
  ASSERT_EQ(result.planes.size(), 1u) << "velocities and forces have no exact rate";
  EXPECT_EQ(result.planes[0].name, "x");
  ASSERT_EQ(result.planes[0].curves.size(), 1u);
  const auto &curve = result.planes[0].curves[0];
  EXPECT_EQ(curve.begins, std::vector<std::size_t>{0});
  for (std::size_t i = 0; i < curve.x.size(); ++i)
    EXPECT_NEAR(std::hypot(curve.x[i], curve.rate[i] / 1.4), a, 1e-8 * a);
}

/// The plane reaches twice as far as the motions; both stable ones have their share of it.
TEST(BasinScene, AsksForAPlaneByTheNamesOfTheStart)
{
  PeriodicRequest request     = request_by("minimise");
  request.own["starts"]       = 12;
  request.basins              = "slide, slide'";
  request.basin_points        = 6;
  const std::string    scene  = cubic_slide(0.1, 1., 0.5, 0.3, hertz(1.4));
  const PeriodicResult result = periodic_of(scene, request);
  ASSERT_EQ(result.entries.size(), 3u);
  ASSERT_TRUE(result.basins);
  const coupling::Basins &basins = result.basins->basins;
  double                  x = 0., v = 0.;
  for (const apps::PhasePlane::Curve &curve : result.planes.at(0).curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i)
    {
      x = std::max(x, curve.x[i]);
      v = std::max(v, curve.rate[i]);
    }
  // Symmetric motions; the largest of 256 samples of a period is less than the peak by up to (pi/256)^2/2 = 8e-5 of it,
  // times the curvature there, of the first harmonic's up to 2 with a cubic spring.
  EXPECT_NEAR(basins.plane.x_end, 2. * x, 4e-4 * x);
  EXPECT_NEAR(basins.plane.y_begin, -2. * v, 4e-4 * v);
  double sum = 0.;
  for (int k = 1; k <= 3; ++k)
  {
    EXPECT_EQ(basins.share(k) > 0., result.entries[std::size_t(k) - 1].solution.stable());
    sum += basins.share(k);
  }
  EXPECT_EQ(sum, 1.);

  request.basins    = "slide from -10 mm to 1 m, slide' from 0 to 2";
  const auto &plane = periodic_of(scene, request).basins->basins.plane;
  EXPECT_EQ(plane.x_begin, -0.01);
  EXPECT_EQ(plane.y_end, 2.);
  const auto words = [&](const std::string &text)
  {
    request.basins = text;
    return refusal([&] { periodic_of(scene, request); });
  };
  EXPECT_THAT(words("slid, slide'"), testing::HasSubstr("'slide'"));
  EXPECT_THAT(words("slide"), testing::HasSubstr("two axes"));
  EXPECT_THAT(words("slide, slide"), testing::HasSubstr("the same"));
  EXPECT_THAT(words("slide from 1 to -1, slide'"), testing::HasSubstr("empty range"));
  EXPECT_THAT(words("slide from 1, slide'"), testing::HasSubstr("from -1 to 1"));
}

/// omega^2 = 1 + 3/4 beta a^2 of a cubic spring, over the parameter that the load's frequency is.
TEST(Backbone, OfACubicSpringIsItsFormula)
{
  PeriodicRequest request = request_by("harmonic-balance");
  request.along           = "parameters.Omega";
  request.from            = "0.8";
  request.to              = "2";
  request.points          = 30;
  const std::string text =
      test::quoted("[parameters]\nOmega = 0.8\n") + cubic_slide(0.1, 1., 0.5, 0.3, "Omega/(2*pi) * 1 Hz");
  const PeriodicResult result = periodic_of(text, request);
  ASSERT_GT(result.backbone.size(), 20u);
  double largest = 0.;
  for (const PeriodicEntry &entry : result.backbone)
  {
    const double a = entry.signals[0].amplitude[0];
    EXPECT_NEAR(entry.parameter, std::sqrt(1. + 0.375 * a * a), 1e-9);
    largest = std::max(largest, a);
  }
  EXPECT_GT(largest, 1.9) << "as far as the branch";
}

} // namespace gestell::tests

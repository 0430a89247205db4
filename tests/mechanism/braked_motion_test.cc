// Motions that are braked by an order: every family against what its speed says.

#include "mechanism/joints/motion_law.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

constexpr double v = 0.8, T = 0.5, start = 0.2, order = 1.3;

/// At t of a motion that starts at `start` and is told to brake at `order`, its corners passed as their guards say.
PrescribedMotion motion_at(const BrakedMotion &motion, double t)
{
  double history[3], g;
  motion.start(start, history);
  if (t < order)
    return motion.at(t, history);
  motion.command({"brake"}, order, history);
  while (motion.n_guards(history) > 0)
  {
    motion.guard_values(t, history, &g);
    if (g < 0.)
      break;
    motion.transition(0, t, history);
  }
  return motion.at(t, history);
}

struct Braking
{
  const char                   *name;
  BrakedMotion::Parameters      parameters;
  std::function<double(double)> speed;    ///< over the time from the order on, of v
  double                        end, way; ///< [s], of v T
};

double ramp(double s)
{
  return s < 0. ? 0. : s > 1. ? 1. : s;
}

const std::pair<double, double> ramps[] = {{0.6, 0.}, {0.4, 0.15}}; ///< share, delay [s]

const Braking brakings[] = {
    {"linear", {v, BrakedMotion::Family::linear, T, {}}, [](double t) { return 1. - ramp(t / T); }, T, 0.5},
    {"cosine",
     {v, BrakedMotion::Family::cosine, T, {}},
     [](double t) { return 0.5 * (1. + std::cos(M_PI * ramp(t / T))); },
     T,
     0.5},
    {"shaped",
     {v, BrakedMotion::Family::shaped, T, {{0.6, 0.}, {0.4, 0.15}}},
     [](double t)
     {
       double left = 1.;
       for (const auto &[share, delay] : ramps)
         left -= share * ramp((t - delay) / T);
       return left;
     },
     T + 0.15,
     0.5 + 0.4 * 0.15 / T}};

TEST(BrakedMotion, GoesOnWithItsSpeedAndComesToRest)
{
  for (const auto &[name, parameters, speed, end, way] : brakings)
  {
    const BrakedMotion motion(parameters);
    const double       at_order = v * (order - start);
    EXPECT_NEAR(motion_at(motion, 0.9).value, v * 0.7, 1e-15) << name;
    EXPECT_EQ(motion_at(motion, 0.9).rate, v) << name;
    for (const double after : {1e-12, 0.1, 7.})
    {
      const PrescribedMotion rest = motion_at(motion, order + end + after);
      EXPECT_NEAR(rest.value, at_order + way * v * T, 1e-14) << name;
      EXPECT_EQ(rest.rate, 0.) << name;
      EXPECT_EQ(rest.acceleration, 0.) << name;
    }
  }
}

// The way is the integral of the speed, the acceleration its slope, also behind the end of a ramp that others outlast.
TEST(BrakedMotion, HasTheWayAndTheAccelerationOfItsSpeed)
{
  constexpr double d = 1e-6;
  for (const auto &[name, parameters, speed, end, way] : brakings)
  {
    const BrakedMotion motion(parameters);
    for (const double share : {0.05, 0.2, 0.45, 0.7, 0.9, 0.97})
    {
      const double           t    = share * end;
      const PrescribedMotion here = motion_at(motion, order + t), before = motion_at(motion, order + t - d),
                             after = motion_at(motion, order + t + d);
      EXPECT_NEAR(here.rate, v * speed(t), 1e-14) << name << " at " << t;
      EXPECT_NEAR((after.value - before.value) / (2. * d), here.rate, 1e-9) << name << " at " << t;
      EXPECT_NEAR((after.rate - before.rate) / (2. * d), here.acceleration, 1e-8) << name << " at " << t;
    }
  }
}

// No mass jumps: neither at the order nor where a ramp begins or ends.
TEST(BrakedMotion, NeitherJumpsNorBendsItsWay)
{
  constexpr double d = 1e-9;
  for (const auto &[name, parameters, speed, end, way] : brakings)
  {
    const BrakedMotion motion(parameters);
    for (const double t : {0., 0.15, T, end})
    {
      const PrescribedMotion before = motion_at(motion, order + t - d), after = motion_at(motion, order + t + d);
      EXPECT_NEAR(after.value, before.value, 3. * d * v) << name << " at " << t;
      EXPECT_NEAR(after.rate, before.rate, 10. * d * v / T) << name << " at " << t;
    }
  }
}

} // namespace
} // namespace gestell::tests

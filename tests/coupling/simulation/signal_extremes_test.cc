// Extremes between samples of a signal.

#include "coupling/simulation/signal_extremes.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::coupling;

/// The length of a vector that passes zero twice at 10 kN/s, first at the distance of 10 N, then of 1 N; of some MN at
/// the start, so that it seems smooth to a share of that.
class Passing : public SampledRun
{
public:
  static constexpr double first = 0.05321, at = 0.20345, speed = 1e4;

  static double length(double t)
  {
    const double x = (at - t) / (at - first);
    return std::hypot(1. + 9. * x, speed * x * (t - first) * (1. + 1e4 * std::exp(-t * t / 1e-4)));
  }
  void evaluate(double t, SignalSample &sample) override
  {
    sample.t         = t;
    sample.values[0] = sign * length(t);
    ++looks;
  }

  double sign  = 1.;
  int    looks = 0;
};

SignalSummary extremes_of(Passing &run, double step)
{
  const std::vector<Signal>  signals(1);
  std::vector<SignalSummary> summaries(1);
  SignalExtremes             extremes(run, {}, signals, 0., summaries);
  SignalSample               start{0., {0.}};
  run.evaluate(0., start);
  extremes.restart(start);
  for (int k = 1; k * step < 0.3; ++k)
    extremes.step(k * step);
  return summaries[0];
}

TEST(SignalExtremes, FindTheShortestLengthOfAVectorThatPassesCloseToZeroWithinAStep)
{
  // It is shorter than 2 N for 0.35 ms.  Parabolas through three of its own values turn far above 10 N.
  for (const double step : {4e-3, 2.3e-3, 1e-3})
  {
    Passing             run;
    const SignalSummary found = extremes_of(run, step);
    EXPECT_NEAR(found.min, 1., 1e-3) << step;
    EXPECT_NEAR(found.t_min, Passing::at, 1e-5) << step;

    Passing turned;
    turned.sign = -1.;
    EXPECT_NEAR(extremes_of(turned, step).max, -1., 1e-3) << step;
  }
}

} // namespace

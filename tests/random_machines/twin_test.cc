// The judge that uses nothing of the program: against closed solutions, and whether it finds a machine that is another.

#include "tests/random_machines/judge.h"
#include "tests/random_machines/twin.h"
#include "tests/support/test.h"

#include <unistd.h>

namespace gestell::tests
{
namespace
{

TEST(Twin, TellsTheValuesRatesAndAccelerationsOfAForcedOscillator)
{
  // x'' = -x, and from t = 1 on a force of 1 besides
  Twin                twin;
  const Twin::Measure x = twin.add_coordinate(0.5, 0., 1., 1.);
  twin.add_mass(2., x);
  twin.add_force(x, [](double t, double u, double) { return -2. * u + (t < 1. ? 0. : 2.); });
  twin.add_break(1.);
  twin.tell("x", x, Twin::Quantity::value);
  twin.tell("v", x, Twin::Quantity::rate);
  twin.tell("a", x, Twin::Quantity::acceleration);
  const std::vector<double> reported = twin.history(3., 30, 1e-12);
  ASSERT_EQ(reported.size(), 31u * 3u);
  for (int row = 0; row <= 30; ++row)
  {
    const double t = 0.1 * row, pushed = t > 1. ? 1. : 0.;
    const double exact = 0.5 * std::cos(t) + pushed * (1. - std::cos(t - 1.));
    EXPECT_NEAR(reported[3 * row], exact, 1e-10);
    EXPECT_NEAR(reported[3 * row + 1], -0.5 * std::sin(t) + pushed * std::sin(t - 1.), 1e-10);
    if (row != 10) // the force jumps
    {
      EXPECT_NEAR(reported[3 * row + 2], pushed - exact, 1e-10);
    }
  }
}

TEST(Twin, ABeadOnARodThatIsTurned_IsThrownOutAsItsClosedSolutionSays)
{
  // r'' = w^2 r on a rod that turns at w: r = cosh(w t), in coordinates of space
  constexpr double    w = 2.;
  Twin                twin;
  const Twin::Measure r   = twin.add_coordinate(1., 0., 1., w);
  const Twin::Measure x   = [=](const Jet *q, const Jet &t) { return r(q, t) * cos(w * t); },
                      y   = [=](const Jet *q, const Jet &t) { return r(q, t) * sin(w * t); };
  const Twin::Measure far = [=](const Jet *q, const Jet &t) { return sqrt(x(q, t) * x(q, t) + y(q, t) * y(q, t)); };
  twin.add_mass(3., x);
  twin.add_mass(3., y);
  twin.tell("r", far, Twin::Quantity::value);
  twin.tell("a", far, Twin::Quantity::acceleration);
  const std::vector<double> reported = twin.history(1.5, 1, 1e-12);
  ASSERT_EQ(reported.size(), 4u);
  EXPECT_NEAR(reported[2], std::cosh(3.), 1e-9);
  EXPECT_NEAR(reported[3], w * w * std::cosh(3.), 1e-9);
}

TEST(Twin, FindsWeightsThatAreAThousandthOff)
{
  const auto folder = std::filesystem::temp_directory_path() / ("twin_" + std::to_string(::getpid()));
  // The first bars that swing under their weight without play.
  std::uint64_t seed    = 2201;
  RandomMachine machine = random_machine(seed);
  while (machine.kind != "bars" || !machine.twin)
    machine = random_machine(++seed);
  const std::string as_it_is = "-9.81]", changed = "-9.82]";
  machine.scene.replace(machine.scene.find(as_it_is), as_it_is.size(), changed);
  bool found = false;
  for (const Finding &finding : judge(machine, folder).findings)
    found = found || finding.kind == "differs from the twin";
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(found) << seed;
}

} // namespace
} // namespace gestell::tests

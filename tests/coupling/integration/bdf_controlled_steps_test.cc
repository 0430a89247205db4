// Steps of controlled BDF that are refused, cut or repeated.

#include "coupling/integration/bdf/bdf_controlled.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/modal_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// A spring so hard that Newton needs two iterations now and then; its law fails at the call with number `call`,
/// counted from 1, if there is one.
struct FailingSpring
{
  long call, calls = 0;

  void operator()(double u, double, double &p, double &dp_du, double &dp_dv)
  {
    p     = ++calls == call ? std::nan("") : -std::pow(u, 9);
    dp_du = -9. * std::pow(u, 8);
    dp_dv = 0.;
  }
};

struct CommandedProfile
{
  std::vector<std::array<double, 4>> motion;   ///< t, q, q', p after each step
  std::vector<long>                  calls;    ///< of the law up to there
  std::vector<long>                  rejected; ///< steps, up to there
};

CommandedProfile course(long failing_call)
{
  auto       spring = std::make_shared<FailingSpring>(FailingSpring{failing_call});
  const auto law    = [spring](double u, double v, double &p, double &du, double &dv) { (*spring)(u, v, p, du, dv); };
  const ModalSystem system = oscillator(1., 0.5, 1., law);
  BdfControlled     bdf(system, {1e-2, 1., 0., 2});
  bdf.begin(0., Vector::Constant(1, 2.), Vector::Zero(1));
  CommandedProfile result;
  for (int i = 0; i < 400; ++i)
  {
    bdf.advance();
    result.motion.push_back({bdf.time(), bdf.instant().q[0], bdf.instant().v[0], bdf.local().p[0]});
    result.calls.push_back(spring->calls);
    result.rejected.push_back(bdf.work().rejected);
  }
  return result;
}

// Whether Newton fails at its first or its second iteration, what remains of the step is nothing: all that follows is
// the same, bit by bit.
TEST(BdfControlled, NothingOfARejectedStepSurvives)
{
  const CommandedProfile plain = course(0);
  int                    step  = 20; // one of two iterations, taken at once
  while (plain.calls[step] < plain.calls[step - 1] + 2 || plain.rejected[step] > plain.rejected[step - 1])
    ASSERT_LT(++step, 399);
  const CommandedProfile first = course(plain.calls[step - 1] + 1), second = course(plain.calls[step - 1] + 2);
  EXPECT_EQ(first.motion, second.motion);
  EXPECT_TRUE(std::equal(plain.motion.begin(), plain.motion.begin() + step, first.motion.begin()));
  const auto length = [&](const CommandedProfile &c) { return c.motion[step][0] - c.motion[step - 1][0]; };
  EXPECT_DOUBLE_EQ(length(first), 0.5 * length(plain));
}

TEST(BdfControlled, StepsWhoseNewtonFailsAreHalved)
{
  // u = u_free + h_b^2 400 u^2 has no root for large steps.
  const ModalSystem system =
      oscillator(1., 0., 1e-6, law_of([](double u) { return 400. * u * u; }, [](double u) { return 800. * u; }));
  BdfControlled bdf(system, {0.1, 32.});
  bdf.begin(0., Vector::Ones(1), Vector::Zero(1));
  bdf.advance();
  EXPECT_GT(bdf.work().rejected, 0);
  EXPECT_LT(1600. * std::pow(bdf.step(), 2), 10.);
  EXPECT_TRUE(bdf.instant().q.allFinite());
}

TEST(BdfControlled, AtTheFloorTheMessageNamesTimeStepReasonAndCoordinate)
{
  const auto message = [](const ModalSystem &system)
  {
    BdfControlled bdf(system, {1e-6, 0.01, 1e-6});
    bdf.begin(0., Vector::Ones(1), Vector::Zero(1));
    Instant last = bdf.instant();
    try
    {
      for (;;)
      {
        bdf.advance();
        last = bdf.instant();
      }
    }
    catch (const ConvergenceFailure &failure)
    {
      EXPECT_EQ(bdf.time(), last.t); // the last one accepted is still there
      EXPECT_EQ(bdf.instant().q, last.q);
      EXPECT_EQ(bdf.instant().v, last.v);
      return std::string(failure.what());
    }
  };
  const auto contains = [](const std::string &text, const std::string &part) { return text.find(part) != text.npos; };
  // No force is defined beyond 1.2; before, 400 pushes there within 0.0316 s.
  const std::string undefined = message(oscillator(
      1., 0., 1., law_of([](double u) { return u > 1.2 ? std::nan("") : 400.; }, [](double) { return 0.; })));
  for (const char *part : {"t = 0.0316", "smallest", "1e-06 s", "Newton", "q0"})
    EXPECT_TRUE(contains(undefined, part)) << part << " in " << undefined;
  // A force that jumps back and forth with every micrometre.
  const std::string rough = message(
      oscillator(1., 0., 1.,
                 law_of([](double u) { return std::fmod(1e6 * u, 2.) < 1. ? 1e5 : -1e5; }, [](double) { return 0.; })));
  for (const char *part : {"times the tolerance 1e-06", "q0", "Locate events"})
    EXPECT_TRUE(contains(rough, part)) << part << " in " << rough;
}

TEST(BdfControlled, BeginsFromRestWhateverPowerTheLoadGrowsWith)
{
  // x'' + 100 x = 30 sin 8 t from rest: x grows with t^3, and no step is small beside such a motion.
  ModalSystem system(Matrix::Identity(1, 1), Matrix::Zero(1, 1), Matrix::Constant(1, 1, 100.));
  system.loads().add_harmonic(0, 8., 0., 30.);
  for (const double tolerance : {1e-2, 1e-5, 1e-8})
  {
    BdfControlled bdf(system, {tolerance, 0.05});
    bdf.begin(0., Vector::Zero(1), Vector::Zero(1));
    while (bdf.time() < 0.1)
      bdf.advance();
    const double t = bdf.time(), exact = 30. / 36. * (std::sin(8. * t) - 0.8 * std::sin(10. * t));
    EXPECT_NEAR(bdf.instant().q[0], exact, 2. * tolerance * exact);
    EXPECT_LT(bdf.work().steps, 2000);
  }
}

TEST(BdfControlled, IsNotDeceivedByStepsNearThePoleOfAFallingCharacteristic)
{
  // u'' = k u = cosh: where h_b^2 k comes near 1, a trial step is large without bound, and refused.  k over one octave
  // of steps, so that some come near.
  for (const double tolerance : {1e-4, 1e-6})
    for (int i = 0; i < 50; ++i)
    {
      const double k = 1024. * std::pow(4., (i + 0.5) / 50.), w = std::sqrt(k - 1e-6);
      const auto system = oscillator(1., 0., 1e-6, law_of([k](double u) { return k * u; }, [k](double) { return k; }));
      BdfControlled bdf(system, {tolerance, 1.});
      bdf.begin(0., Vector::Ones(1), Vector::Zero(1));
      double worst = 0.;
      while (bdf.time() < 6. / w)
      {
        bdf.advance();
        const double exact = std::cosh(w * bdf.time());
        worst              = std::max(worst, std::abs(bdf.instant().q[0] - exact) / exact);
      }
      EXPECT_LT(worst, 10. * tolerance) << k;
    }
}

TEST(BdfControlled, MaybeCutAnywhereAndAgainAndAtItsBegin)
{
  const ModalSystem system = duffing(1., 1.);
  BdfControlled     bdf(system, {1e-5, 0.25});
  bdf.begin(0., Vector::Constant(1, 2.), Vector::Zero(1));
  for (int i = 0; i < 60; ++i)
  {
    const Instant before = bdf.instant();
    bdf.advance();
    const Instant after  = bdf.instant();
    const double  middle = 0.5 * (before.t + after.t);
    LocalState    dense;
    dense.resize(1);
    bdf.interpolate(middle, dense);
    bdf.cut(middle);
    EXPECT_EQ(bdf.time(), middle);
    EXPECT_EQ(bdf.instant().q[0], dense.u[0]);
    bdf.cut(after.t - 0.1 * (after.t - before.t)); // later again
    bdf.cut(middle);
    EXPECT_EQ(bdf.instant().q[0], dense.u[0]);
    // The dense output meets both ends, and keeps the energy as they do: x'^2/2 + x^2/2 + x^4/4 = 6.
    const double x = dense.u[0], v = dense.v[0];
    EXPECT_NEAR(0.5 * (v * v + x * x) + 0.25 * x * x * x * x, 6., 1e-3);
    bdf.cut(before.t);
    EXPECT_EQ(bdf.time(), bdf.step_begin());
    EXPECT_EQ(bdf.instant().q, before.q);
    EXPECT_EQ(bdf.instant().v, before.v);
    bdf.cut(after.t);
    EXPECT_NEAR(bdf.instant().q[0], after.q[0], 1e-13);
    if (i % 20 != 19)
      continue;
    bdf.cut(middle);
    bdf.restart();
    EXPECT_EQ(bdf.time(), middle);
    EXPECT_EQ(bdf.step_begin(), middle);
  }
}

TEST(BdfControlled, IsTheSameEveryTimeAndTakesNothingFromTheHeap)
{
  ModalSystem system = duffing(1., 1.);
  system.loads().add_harmonic(0, 2., 0.3, 0.1);
  BdfControlled bdf(system, {1e-5, 0.25});
  double        end[2] = {};
  for (double &q : end)
  {
    bdf.begin(0., Vector::Constant(1, 2.), Vector::Zero(1));
    long in_steps = 0;
    for (int i = 0; i < 2000; ++i)
    {
      const long known = bdf.work().factorisations, before = allocations;
      bdf.advance();
      if (bdf.work().factorisations == known)
        in_steps += allocations - before;
    }
    q = bdf.instant().q[0];
    EXPECT_EQ(in_steps, 0);
  }
  EXPECT_EQ(end[0], end[1]);
}

/// A mass that sticks where it is.
class StuckMass : public ModalSystem
{
public:
  StuckMass() : ModalSystem(Matrix::Identity(1, 1), Matrix::Zero(1, 1), Matrix::Constant(1, 1, 100.))
  {
    set_law(Vector::Ones(1), [](double, double, double &, double &, double &) {}); // p is what holds it
    loads().add_harmonic(0, 4., 10., 0.);
  }
  const std::vector<HeldMeasure> &held() const override { return held_; }

private:
  std::vector<HeldMeasure> held_{{0, 0.}};
};

TEST(BdfControlled, WhatHoldsAMassFollowsFromEquilibrium)
{
  const StuckMass system;
  const double    x = 0.05;
  BdfControlled   bdf(system, {1e-6, 0.01});
  const auto      force = [&](double t) { return 100. * x - 10. * std::cos(4. * t); };
  bdf.begin(0., Vector::Constant(1, x), Vector::Zero(1));
  EXPECT_NEAR(bdf.local().p[0], force(0.), 1e-12);
  for (int i = 0; i < 100; ++i)
  {
    bdf.advance();
    EXPECT_NEAR(bdf.instant().q[0], x, 1e-14);
    EXPECT_NEAR(bdf.local().p[0], force(bdf.time()), 1e-9);
  }
  EXPECT_EQ(bdf.step(), 0.01); // nothing moves: no error
  LocalState dense;
  dense.resize(1);
  const double middle = bdf.time() - 0.4 * bdf.step();
  bdf.interpolate(middle, dense);
  EXPECT_NEAR(dense.p[0], force(middle), 2e-6); // cubic: 10 (4 h)^4 / 24
  bdf.cut(middle);
  EXPECT_NEAR(bdf.local().p[0], force(middle), 1e-12); // as at a restart there
}

/// A mass at rest that a force pulls and another holds; other measures of it are only looked at, as a switch does.
class HeldAgainstAPull : public ModalSystem
{
public:
  HeldAgainstAPull(double pull, int n_measures)
      : ModalSystem(Matrix::Constant(1, 1, 66.78), Matrix::Constant(1, 1, 14416.), Matrix::Constant(1, 1, 3.3638e7))
  {
    set_law(Vector::Ones(1),
            [pull](double, double, double &p, double &du, double &dv)
            {
              p  = pull;
              du = dv = 0.;
            });
    W = Matrix::Ones(1, n_measures).sparseView();
  }
  const std::vector<HeldMeasure> &held() const override { return held_; }

private:
  std::vector<HeldMeasure> held_{{1, 0.}};
};

// Forces that cancel leave rounding of what each would move, in all measures of the body.
TEST(BdfControlled, MeasuresWithoutAForceOfABodyThatIsHeldHaveNoError)
{
  for (int n_measures = 2; n_measures < 10; ++n_measures)
    for (double pull = 0.1; pull < 1e4; pull *= 1.37)
    {
      const HeldAgainstAPull system(pull, n_measures);
      BdfControlled          bdf(system, {1e-8, 1e-3});
      bdf.begin(0., Vector::Zero(1), Vector::Zero(1));
      for (int i = 0; i < 20; ++i)
        ASSERT_NO_THROW(bdf.advance()) << pull << " " << n_measures;
      EXPECT_EQ(bdf.step(), 1e-3) << pull << " " << n_measures;
      EXPECT_NEAR(bdf.local().p[1], -pull, 1e-12 * pull);
    }
}

TEST(BdfControlled, RefusesOptionsThatMakeNoSense)
{
  const ModalSystem system = duffing(1., 1.);
  const auto        refuse = [&](auto change)
  {
    BdfControlled::Options options;
    options.largest_step = 0.1;
    change(options);
    EXPECT_THROW(BdfControlled(system, options), std::invalid_argument);
  };
  refuse([](auto &o) { o.tolerance = 0.; });
  refuse([](auto &o) { o.tolerance = 1e-14; });
  refuse([](auto &o) { o.tolerance = 0.2; });
  refuse([](auto &o) { o.max_order = 7; });
  refuse([](auto &o) { o.min_order = -1; });
  refuse([](auto &o) { o.min_order = 6; });
  refuse([](auto &o) { o.largest_step = -1.; });
  refuse([](auto &o) { o.smallest_step = 1.; });
}

} // namespace
} // namespace gestell::tests

// The method that carries derivatives along a motion: its order.

#include "coupling/sensitivity/variational_steps.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::coupling;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double mass = 2., stiffness = 98., omega = 7., q_0 = 0.01, T = 1.;

Machine damped_oscillator(double c)
{
  MachineModel model;
  model.add_slider("x", {1., 0., 0.}, mass, "ground");
  model.add_linear("spring", {{model.coordinate("x"), 1.}}, {c, 0., 0., 0.}, "N");
  return Machine(std::move(model));
}

/// q_0 cos(omega t), by nodes so close that what lies between them is known to 1e-10.
SmoothPiece exact_motion(int n = 800)
{
  SmoothPiece piece;
  for (int i = 0; i <= n; ++i)
  {
    const double t = T * i / n;
    piece.nodes.push_back({t, VectorXd::Constant(1, q_0 * std::cos(omega * t)),
                           VectorXd::Constant(1, -q_0 * omega * std::sin(omega * t))});
  }
  return piece;
}

/// Of dq/dc at T, by n equal steps.
double end_error(int n)
{
  Machine machine = damped_oscillator(stiffness), below = damped_oscillator(stiffness * (1. - 1e-6)),
          above                     = damped_oscillator(stiffness * (1. + 1e-6));
  std::vector<ParameterTwins> twins = {
      {"c", "N/m", stiffness, 1e-6 * stiffness, {&below, {}, {}, T}, {&above, {}, {}, T}}};
  VariationalEquation equation(machine, twins);
  VariationalSteps    steps(equation, T / n, 1e300);
  const SmoothPiece   piece = exact_motion();
  steps.begin(piece, VectorXd(), MatrixXd::Zero(1, 1), MatrixXd::Zero(1, 1));
  for (int i = 1; i <= n; ++i)
    steps.advance_to(T * i / n);
  EXPECT_EQ(steps.steps(), n);
  return std::abs(steps.columns().q(0, 0) + q_0 * std::sin(omega * T) * T * omega / (2. * stiffness));
}

TEST(VariationalSteps, HaveOrderFour)
{
  EXPECT_NEAR(std::log2(end_error(20) / end_error(40)), 4., 0.3);
  EXPECT_NEAR(std::log2(end_error(40) / end_error(80)), 4., 0.15);
}

/// What a run of n steps by a method of order p is told to make of dq/dc.
double told_accuracy(int n, int p)
{
  Machine machine = damped_oscillator(stiffness), below = damped_oscillator(stiffness * (1. - 1e-6)),
          above                     = damped_oscillator(stiffness * (1. + 1e-6));
  std::vector<ParameterTwins> twins = {
      {"c", "N/m", stiffness, 1e-6 * stiffness, {&below, {}, {}, T}, {&above, {}, {}, T}}};
  VariationalEquation equation(machine, twins);
  VariationalSteps    steps(equation, T / 100., 1e300, p, T / n);
  const SmoothPiece   piece   = exact_motion(n);
  const double        largest = q_0 * omega * T / (2. * stiffness);
  steps.expect(MatrixXd::Constant(1, 1, largest), MatrixXd::Constant(1, 1, omega * largest));
  steps.begin(piece, VectorXd(), MatrixXd::Zero(1, 1), MatrixXd::Zero(1, 1));
  for (int i = 1; i <= 100; ++i)
    steps.advance_to(T * i / 100.);
  return steps.accuracy().off[0];
}

TEST(VariationalSteps, ReportWhatTheMethodOfTheRunWouldDoToDerivatives)
{
  // h^2/3 omega^3 T of order 2 and h/2 omega^2 T of order 1, as s' goes through omega T, but for a
  // factor: s grows to its largest at T.
  const double h = T / 800.;
  EXPECT_NEAR(std::log2(told_accuracy(400, 2) / told_accuracy(800, 2)), 2., 0.05);
  EXPECT_NEAR(std::log2(told_accuracy(400, 1) / told_accuracy(800, 1)), 1., 0.05);
  EXPECT_NEAR(std::log(told_accuracy(800, 2) / (h * h / 3. * omega * omega * omega * T)), 0., std::log(3.));
  EXPECT_NEAR(std::log(told_accuracy(800, 1) / (h / 2. * omega * omega * T)), 0., std::log(3.));
  EXPECT_EQ(told_accuracy(800, 0), 0.);
}

/// Error that is told, and the error, of ds/dx = cos(omega t) after so many periods, by steps of a 25th of one.
std::pair<double, double> of_oscillation(int periods)
{
  const double period = 2. * M_PI / omega, spacing = 0.8 * period;
  Machine      machine = damped_oscillator(stiffness), below = damped_oscillator(stiffness),
          above                           = damped_oscillator(stiffness);
  const std::vector<ParameterTwins> twins = {{"q_0", "m", q_0, 1e-6 * q_0, {&below, {}, {}, T}, {&above, {}, {}, T}}};
  VariationalEquation               equation(machine, twins);
  VariationalSteps                  steps(equation, spacing / 20., 1e-12); // which none of them meets
  SmoothPiece                       piece;
  for (int i = 0; i <= int(periods / 0.8); ++i)
    piece.nodes.push_back({i * spacing, VectorXd::Zero(1), VectorXd::Zero(1)});
  steps.begin(piece, VectorXd(), MatrixXd::Identity(1, 1), MatrixXd::Zero(1, 1));
  const double end = piece.nodes.back().t;
  steps.advance_to(end);
  EXPECT_EQ(steps.steps(), 20 * long(piece.nodes.size() - 1));
  return {steps.accuracy().off[0], std::abs(steps.columns().q(0, 0) - std::cos(omega * end))};
}

TEST(VariationalSteps, TellErrorsThatOscillateWithWhatTheyAreOf)
{
  // Half of these are positive, half negative, and their sum over whole periods vanishes; what they make of the motion
  // grows in proportion to the periods.
  const auto [reported, error]        = of_oscillation(16);
  const auto [told_longer, its_error] = of_oscillation(32);
  EXPECT_GT(reported, error);
  EXPECT_GT(told_longer, its_error);
  EXPECT_NEAR(told_longer / reported, 2., 0.2);
}

TEST(VariationalSteps, DivideALastStepThatIsAHairLongerThanTheirOwn)
{
  Machine machine = damped_oscillator(stiffness), below = damped_oscillator(stiffness),
          above                           = damped_oscillator(stiffness);
  const std::vector<ParameterTwins> twins = {{"q_0", "m", q_0, 1e-6 * q_0, {&below, {}, {}, T}, {&above, {}, {}, T}}};
  VariationalEquation               equation(machine, twins);
  constexpr double                  step = 0.02, hair = 1.00005;
  VariationalSteps                  steps(equation, step, 1e-12);
  const SmoothPiece                 piece = exact_motion(10); // of 0.1 s: steps are divided down to 6 ms
  steps.begin(piece, VectorXd(), MatrixXd::Identity(1, 1), MatrixXd::Zero(1, 1));
  EXPECT_TRUE(steps.advance_to(hair * step));
  EXPECT_GT(steps.steps(), 2);
}

/// s at the end of 4 half periods of the oscillator moved by one second, dq/dx = q', along the motion of a run whose
/// frequency is off by 1e-5.
double of_a_moved_motion(bool separate)
{
  Machine machine = damped_oscillator(stiffness), below = damped_oscillator(stiffness),
          above                           = damped_oscillator(stiffness);
  const std::vector<ParameterTwins> twins = {{"t_0", "s", 1., 1e-6, {&below, {}, {}, T}, {&above, {}, {}, T}}};
  VariationalEquation               equation(machine, twins);
  VariationalSteps                  steps(equation, 0.01, 1e-9);
  const double                      its = omega * (1. + 1e-5), end = 4. * M_PI / its;
  SmoothPiece                       piece;
  for (int i = 0; i <= 800; ++i)
  {
    const double t = end * i / 800.;
    piece.nodes.push_back(
        {t, VectorXd::Constant(1, q_0 * std::cos(its * t)), VectorXd::Constant(1, -q_0 * its * std::sin(its * t))});
  }
  if (separate)
    steps.separate_shifts(VectorXd::Constant(1, 2. * q_0), VectorXd::Constant(1, q_0 * omega),
                          Eigen::RowVectorXd::Constant(1, 100.));
  steps.begin(piece, VectorXd(), MatrixXd::Zero(1, 1), MatrixXd::Constant(1, 1, -q_0 * omega * omega));
  steps.advance_to(end);
  return std::abs(steps.columns().q(0, 0));
}

TEST(VariationalSteps, MoveTheErrorsOfTheRunWithItsMotionInTime)
{
  // There the motion turns, and its extreme does not depend on t_0; of the equations the phase is 4 pi 1e-5 ahead.
  EXPECT_LT(of_a_moved_motion(true), 1e-9 * q_0 * omega);
  EXPECT_NEAR(of_a_moved_motion(false), 4. * M_PI * 1e-5 * q_0 * omega, 1e-6 * q_0 * omega);
}

TEST(VariationalSteps, DoNotMoveWhatTheTimeItselfDrives)
{
  // q = A cos(Omega t) under a load; s = -A Omega^2 sin(omega t)/omega begins as q' does, and is free of the load.
  const double Omega = 5., A = 0.01;
  const auto   loaded = [&]
  {
    MachineModel model;
    const int    x = model.add_slider("x", {1., 0., 0.}, mass, "ground");
    model.add_linear("spring", {{x, 1.}}, {stiffness, 0., 0., 0.}, "N");
    model.add_load("drive", {{x, 1.}}, 0., {{Omega, A * (stiffness - mass * Omega * Omega), M_PI / 2.}}, "N");
    return Machine(std::move(model));
  };
  Machine                           machine = loaded(), below = loaded(), above = loaded();
  const std::vector<ParameterTwins> twins = {{"v_0", "m/s", 1., 1e-6, {&below, {}, {}, T}, {&above, {}, {}, T}}};
  VariationalEquation               equation(machine, twins);
  VariationalSteps                  steps(equation, 0.01, 1e-10);
  SmoothPiece                       piece;
  for (int i = 0; i <= 800; ++i)
  {
    const double t = T * i / 800.;
    piece.nodes.push_back(
        {t, VectorXd::Constant(1, A * std::cos(Omega * t)), VectorXd::Constant(1, -A * Omega * std::sin(Omega * t))});
  }
  steps.separate_shifts(VectorXd::Constant(1, 2. * A), VectorXd::Constant(1, A * Omega),
                        Eigen::RowVectorXd::Constant(1, 100.));
  steps.begin(piece, VectorXd(), MatrixXd::Zero(1, 1), MatrixXd::Constant(1, 1, -A * Omega * Omega));
  steps.advance_to(T);
  EXPECT_NEAR(steps.columns().q(0, 0), -A * Omega * Omega * std::sin(omega * T) / omega, 1e-8 * A * Omega);
}

} // namespace

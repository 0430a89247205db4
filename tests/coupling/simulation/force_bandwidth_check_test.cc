// What a reduced frame makes of fast forces, against the error of the run.

#include "coupling/simulation/checks/force_bandwidth_check.h"

#include "coupling/algebra/dense_modes.h"
#include "mechanism/elements/table_force.h"
#include "tests/support/methods.h"
#include "tests/support/test.h"

#include <Eigen/Cholesky>

namespace gestell::test
{
namespace
{

using Eigen::ArrayXd;

coupling::OscillatorBank oscillator(double omega, double zeta)
{
  return {ArrayXd::Constant(1, omega), ArrayXd::Constant(1, zeta)};
}

ArrayXd one(double u)
{
  return ArrayXd::Constant(1, u);
}

TEST(OscillatorBank, FollowsARampExactlyInStepsOfAnyLength)
{
  // From rest, under u = r t:  x = r t - 2 zeta r / omega + exp(-zeta omega t) (...), by which x and x' begin at zero.
  const double omega = 70., zeta = 0.1, r = 3., t = 0.05, s = std::sqrt(1. - zeta * zeta);
  const double late = 2. * zeta * r / omega, swings = s * omega * t;
  const double x =
      r * t - late +
      std::exp(-zeta * omega * t) * (late * std::cos(swings) + (zeta * late - r / omega) / s * std::sin(swings));
  for (const int steps : {1, 7, 500})
  {
    auto bank = oscillator(omega, zeta);
    bank.begin(one(0.));
    for (int k = 1; k <= steps; ++k)
      bank.advance(t / steps, one(r * t * k / steps));
    EXPECT_NEAR(bank.x()[0], x, 1e-12) << steps;
  }
}

TEST(OscillatorBank, SwingsToTwiceAStepAndComesToRestOnIt)
{
  auto bank = oscillator(100., 0.);
  bank.begin(one(5.));
  bank.jump(one(8.));
  EXPECT_EQ(bank.x()[0], 5.);
  bank.advance(M_PI / 100., one(8.)); // half a period
  EXPECT_NEAR(bank.x()[0], 11., 1e-12);

  bank = oscillator(100., 0.5);
  bank.begin(one(5.));
  bank.jump(one(8.));
  bank.advance(1., one(8.));
  EXPECT_NEAR(bank.x()[0], 8., 1e-12);
}

/// A rod of 1 m, 100 kg, EA = 1e8 N, clamped at one end; its first frequency is 250 Hz.
constexpr int    pieces    = 40;
constexpr double stiffness = 1e8, weight = 100.;

/// Its reduction by Craig and Bampton with m modes, the free end its interface.
coupling::ReducedFrame rod(int m)
{
  constexpr int         inner = pieces - 1;
  const Eigen::VectorXd ones  = Eigen::VectorXd::Ones(inner);
  Eigen::MatrixXd       C = Eigen::MatrixXd::Zero(pieces, pieces), M = C;
  for (int i = 0; i < pieces; ++i) // the interface comes first, the clamped end is left out
    for (const int j : {i - 1, i, i + 1})
      if (j >= 0 && j < pieces)
      {
        const double both = i == 0 && j == 0 ? 1. : 2.;
        C(i, j)           = stiffness * pieces * (i == j ? both : -1.);
        M(i, j)           = weight / pieces / 6. * (i == j ? 2. * both : 1.);
      }
  const Eigen::MatrixXd C22     = C.bottomRightCorner(inner, inner);
  const auto            fixed   = coupling::dense_modes(C22, M.bottomRightCorner(inner, inner));
  Eigen::MatrixXd       T       = Eigen::MatrixXd::Zero(pieces, 1 + m);
  T(0, 0)                       = 1.;
  T.bottomLeftCorner(inner, 1)  = -C22.llt().solve(C.bottomLeftCorner(inner, 1));
  T.bottomRightCorner(inner, m) = fixed.V.leftCols(m);

  coupling::ReducedFrame reduced;
  reduced.M = T.transpose() * M * T;
  reduced.C = T.transpose() * C * T;
  reduced.M.bottomRightCorner(m, m).setIdentity();
  reduced.C.topRightCorner(1, m).setZero();
  reduced.C.bottomLeftCorner(m, 1).setZero();
  reduced.C.bottomRightCorner(m, m) = fixed.omega.head(m).cwiseAbs2().asDiagonal();
  reduced.n_interface               = 1;
  reduced.n_full                    = pieces;
  reduced.omega0                    = fixed.omega.head(m);
  reduced.translations_load         = Eigen::MatrixXd::Zero(1 + m, 3);
  const auto            modes       = coupling::dense_modes(reduced.C, reduced.M);
  const Eigen::VectorXd omega       = modes.omega;
  reduced.frequencies_hz            = omega / (2. * M_PI);
  const Eigen::MatrixXd Y           = C.llt().solve(M * T * modes.V); // reduction.md (14)
  reduced.frequency_error =
      omega.cwiseQuotient(coupling::dense_modes(Y.transpose() * C * Y, Y.transpose() * M * Y).omega).array() - 1.;
  reduced.B = 0.02 / omega[0] * reduced.C; // 1 % of the first
  fem::Interface tip;
  tip.name           = "tip";
  tip.coordinate[0]  = 0;
  reduced.interfaces = {tip};
  return reduced;
}

struct Drop
{
  std::vector<double> history;
  std::string         warnings;
};

/// 10 kN set down on the tip within `rise`, from rest.
Drop set_down(const coupling::ReducedFrame &frame, double rise)
{
  coupling::MachineModel model;
  model.set_frame(frame);
  mechanism::TableForce::Parameters load;
  load.rows = {{0., 0.}, {1e-3, 0.}, {1e-3 + rise, 1e4}, {1., 1e4}};
  model.attach("load", std::make_shared<mechanism::TableForce>(load), {{{model.coordinate("frame.tip.ux"), 1.}}});
  coupling::Machine    machine(std::move(model));
  coupling::RunOptions options = tests::run_of(tests::bdf(2, 5e-6), 1e-3 + rise + 0.012); // three periods
  options.output_step          = 5e-6;
  const auto run = coupling::simulate(machine, tests::at_rest(machine), options, {machine.signal("x", "frame.tip.ux")});
  Drop       drop;
  for (std::size_t i = 1; i < run.rows.size(); i += run.columns.size())
    drop.history.push_back(run.rows[i]);
  for (const std::string &warning : coupling::texts_of(run.findings))
    drop.warnings += warning + '\n';
  return drop;
}

/// Of the largest deflection.
double largest_error(const Drop &model, const Drop &truth)
{
  double error = 0., deflection = 0.;
  for (std::size_t i = 0; i < truth.history.size(); ++i)
  {
    error      = std::max(error, std::abs(model.history[i] - truth.history[i]));
    deflection = std::max(deflection, std::abs(truth.history[i]));
  }
  return error / deflection;
}

/// 0: nothing is told.
double reported(const Drop &drop)
{
  const std::size_t about = drop.warnings.find(", about ");
  return about == std::string::npos ? 0. : 0.01 * std::strtod(drop.warnings.c_str() + about + 8, nullptr);
}

TEST(ForceBandwidthCheck, OfALoadSetDownLeaveTheDoubtThatIsReported)
{
  const auto full = rod(pieces - 1);
  for (const int m : {1, 2})
  {
    auto reduced               = rod(m);
    reduced.frequency_limit_hz = 1.02 * full.frequencies_hz[0];
    for (const double rise : {0.02, 0.1, 0.3, 1., 4.}) // periods of the limit
    {
      const double t     = rise / reduced.frequency_limit_hz;
      const Drop   truth = set_down(full, t), model = set_down(reduced, t);
      EXPECT_EQ(truth.warnings, "");
      const double error = largest_error(model, truth);
      EXPECT_GT(reported(model) + 0.05, 0.7 * error) << m << ' ' << rise << model.warnings; // what is not worth a word
      if (reported(model) == 0.)
        continue;
      EXPECT_GT(reported(model), 0.7 * error) << m << ' ' << rise;
      EXPECT_LT(reported(model), 1.5 * error) << m << ' ' << rise;
      EXPECT_NE(model.warnings.find("reduction.frequency"), std::string::npos);
    }
  }
}

TEST(ForceBandwidthCheck, OfUnknownFrequenciesAreTakenForThoseBehindTheRange)
{
  auto reduced               = rod(1);
  reduced.frequency_limit_hz = 400.; // the second of the full rod is 750 Hz, of the reduced one above
  reduced.frequency_error[1] = NAN;
  const double error         = largest_error(set_down(reduced, 1e-4), set_down(rod(pieces - 1), 1e-4));
  EXPECT_GT(reported(set_down(reduced, 1e-4)), 0.7 * error);
}

} // namespace
} // namespace gestell::test

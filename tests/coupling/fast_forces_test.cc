// What forces contain above the frequency a reduced frame is made for, against the error of the run.

#include "coupling/fast_forces.h"

#include "coupling/dense_modes.h"
#include "coupling/simulation.h"
#include "mechanism/elements/table_force.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gestell::test
{
namespace
{

using coupling::HighPass;

TEST(HighPass, LeavesAnOscillationAsButterworthsFilterOfFourthOrder)
{
  const double omega = 100., h = 2e-4; // 1/300 of the shortest period: linear pieces are short by 4e-5
  for (const double ratio : {0.25, 0.5, 1., 4.})
  {
    HighPass             filter;
    const HighPass::Step step(omega, h);
    double               largest = 0.;
    filter.begin(0.);
    for (int k = 1; k < 20000; ++k)
    {
      const double y = filter.advance(step, std::sin(ratio * omega * k * h));
      largest        = k > 10000 ? std::max(largest, std::abs(y)) : 0.;
    }
    const double r4 = std::pow(ratio, 4);
    EXPECT_NEAR(largest, r4 / std::sqrt(1. + r4 * r4), 1e-3) << ratio;
  }
}

TEST(HighPass, IsTheSameForAnyStepsWhereTheInputIsLinear)
{
  HighPass fine, coarse;
  fine.begin(1.);
  coarse.begin(1.);
  const HighPass::Step small(70., 1e-6), large(70., 1e-3);
  double               y = 0.;
  for (int k = 1; k <= 1000; ++k)
    y = fine.advance(small, 1. + 3e-3 * k);
  // The second section takes its input, the output of the first, for linear: (omega h)^2 / 12 of it.
  EXPECT_NEAR(coarse.advance(large, 4.), y, 3. * 70. * 70. * 1e-6 / 6.);
}

TEST(HighPass, PassesAJumpAsAWholeAndForgetsIt)
{
  HighPass filter;
  filter.begin(5.);
  EXPECT_NEAR(filter.jump(8.), 3., 1e-12);
  const HighPass::Step step(100., 1e-3);
  double               y = 0.;
  for (int k = 0; k < 1000; ++k)
    y = filter.advance(step, 8.);
  EXPECT_NEAR(y, 0., 1e-12);
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
  const Eigen::VectorXd omega       = coupling::dense_modes(reduced.C, reduced.M).omega;
  reduced.frequencies_hz            = omega / (2. * M_PI);
  reduced.B                         = 0.02 / omega[0] * reduced.C; // 1 % of the first
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
  coupling::Machine machine;
  machine.set_frame(frame);
  mechanism::TableForce::Parameters load;
  load.rows = {{0., 0.}, {1e-3, 0.}, {1e-3 + rise, 1e4}, {1., 1e4}};
  machine.attach("load", std::make_shared<mechanism::TableForce>(load), {{{machine.coordinate("frame.tip.ux"), 1.}}});
  machine.finish();
  coupling::InitialState rest;
  rest.q = rest.v = Eigen::VectorXd::Zero(machine.size());
  coupling::RunOptions options;
  options.method.step = 5e-6;
  options.output_step = 5e-6;
  options.end         = 1e-3 + rise + 0.012; // three periods
  const auto run      = coupling::simulate(machine, rest, options, {machine.signal("x", "frame.tip.ux")});
  Drop       drop;
  for (std::size_t i = 1; i < run.rows.size(); i += run.columns.size())
    drop.history.push_back(run.rows[i]);
  for (const std::string &warning : run.warnings)
    drop.warnings += warning + '\n';
  return drop;
}

TEST(FastForces, OfALoadSetDownLeaveAboutTheDoubtThatIsTold)
{
  const double static_deflection = 1e4 / stiffness;
  const auto   full              = rod(pieces - 1);
  auto         reduced           = rod(1); // its first frequency is 0.9 % too high
  reduced.frequency_limit_hz     = 1.02 * full.frequencies_hz[0];
  for (const double rise : {0.02, 0.1, 0.3, 1., 4.}) // periods of the limit
  {
    const double t     = rise / reduced.frequency_limit_hz;
    const Drop   truth = set_down(full, t), model = set_down(reduced, t);
    EXPECT_EQ(truth.warnings, "");
    double error = 0.;
    for (std::size_t i = 0; i < truth.history.size(); ++i)
      error = std::max(error, std::abs(model.history[i] - truth.history[i]) / static_deflection);
    const std::size_t about = model.warnings.find("so that about ");
    ASSERT_EQ(about == std::string::npos, rise >= 1.) << model.warnings;
    if (rise >= 1.)
    {
      EXPECT_LT(error, 0.05) << "what is not worth a word";
      continue;
    }
    const double told = 0.01 * std::strtod(model.warnings.c_str() + about + 14, nullptr);
    EXPECT_GT(told, 0.5 * error) << rise;
    EXPECT_LT(told, 2. * error) << rise;
    EXPECT_NE(model.warnings.find("reduction.frequency"), std::string::npos);
  }
}

} // namespace
} // namespace gestell::test

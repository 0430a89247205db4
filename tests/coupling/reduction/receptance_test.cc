#include "coupling/algebra/dense_modes.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/values/two_pi.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/lattice.h"
#include "tests/support/test.h"

#include <Eigen/LU>

namespace gestell
{
namespace
{

using coupling::dense_modes;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::frame_of;
using test::Lattice;
using test::with_modes;

constexpr double zeta = 0.01;

/// Receptance of the interface at some frequencies [rad/s], by modes.
using Receptances = std::vector<MatrixXcd>;

enum class Damping
{
  modal,      // each mode has the ratio zeta
  loss_factor // C (1 + 2 i zeta)
};

/// Of all modes of undamped matrices; the rows `q1` of them.
Receptances by_modes(const MatrixXd &C, const MatrixXd &M, const std::vector<int> &q1,
                     const std::vector<double> &omegas, Damping damping)
{
  const auto     modes = dense_modes(C, M);
  const MatrixXd Phi   = modes.V(q1, Eigen::all);
  Receptances    result;
  for (const double omega : omegas)
  {
    const Eigen::VectorXcd terms = modes.omega.unaryExpr(
        [&](double w)
        {
          const double loss = 2. * zeta * w * (damping == Damping::modal ? omega : w);
          return 1. / std::complex<double>(w * w - omega * omega, loss);
        });
    result.push_back(Phi * terms.asDiagonal() * Phi.transpose());
  }
  return result;
}

/// Of the reduced model as it is.
Receptances reduced(const coupling::ReducedFrame &frame, const std::vector<double> &omegas)
{
  Receptances result;
  for (const double omega : omegas)
  {
    MatrixXcd D(frame.M.rows(), frame.M.rows());
    D.real() = frame.C - omega * omega * frame.M;
    D.imag() = omega * frame.B;
    result.push_back(D.partialPivLu().inverse().topLeftCorner(frame.n_interface, frame.n_interface));
  }
  return result;
}

/// Largest |H - H_full| / |H_full| over the frequencies, coordinates scaled by their own inertia.
double error(const Receptances &H, const Receptances &exact, const VectorXd &scale)
{
  double largest = 0.;
  for (std::size_t i = 0; i < H.size(); ++i)
    largest = std::max(largest, (scale.asDiagonal() * (H[i] - exact[i]) * scale.asDiagonal()).norm() /
                                    (scale.asDiagonal() * exact[i] * scale.asDiagonal()).norm());
  return largest;
}

/// A frame damped by modes alone, of frequency range and frequencies to look at.
struct Case
{
  fem::FrameMatrices  frame;
  double              highest_hz;
  std::vector<double> omegas;
};

Case make_case(double foundation, int last_mode)
{
  Lattice lattice;
  lattice.nx = 6, lattice.ny = 3, lattice.nz = 7;
  lattice.foundation = foundation;
  lattice.damper     = 0.;
  Case result{frame_of(lattice), 0., {}};
  result.frame.modal_damping_ratio = zeta;
  const VectorXd omega             = dense_modes(result.frame.C, result.frame.M).omega;
  const double   highest           = 0.5 * (omega(last_mode) + omega(last_mode + 1));
  result.highest_hz                = highest / two_pi;
  for (int i = 1; i <= 400; ++i)
    result.omegas.push_back(highest * i / 400.);
  for (int j = 0; j <= last_mode; ++j)
    for (int t = -20; t <= 20; ++t)
      if (const double at = omega(j) * (1. + 0.1 * t * zeta); at > 1e-3 * highest && at <= highest)
        result.omegas.push_back(at);
  return result;
}

using ReceptanceNumber = ::testing::TestWithParam<std::tuple<double, int, double>>;

TEST_P(ReceptanceNumber, KeepsTheReceptanceWithinTheToleranceWithHardlyMoreThanTheFewestModes)
{
  const auto [foundation, last_mode, tolerance] = GetParam();
  const Case                 c                  = make_case(foundation, last_mode);
  coupling::ReductionOptions options;
  options.tolerance    = tolerance;
  options.frequency    = c.highest_hz;
  const auto     model = reduce_frame(c.frame, options);
  const VectorXd scale = model.M.diagonal().head(model.n_interface).cwiseSqrt();
  const auto     q1    = c.frame.interface_coordinates();
  const int      m     = int(model.omega0.size());

  // the estimate damps by a loss factor, the model by modes: the same at a resonance; and in the full frame those modes
  // are damped, too, that the model does not have
  EXPECT_LE(error(reduced(model, c.omegas), by_modes(c.frame.C, c.frame.M, q1, c.omegas, Damping::modal), scale),
            1.1 * tolerance + zeta);

  const auto       exact = by_modes(c.frame.C, c.frame.M, q1, c.omegas, Damping::loss_factor);
  std::vector<int> first(model.n_interface);
  std::iota(first.begin(), first.end(), 0);
  const auto error_of = [&](const coupling::ReducedFrame &of)
  { return error(by_modes(of.C, of.M, first, c.omegas, Damping::loss_factor), exact, scale); };
  const double found = error_of(model);
  EXPECT_LE(found, 1.01 * tolerance);                                        // the grids differ
  for (int few = (2 * m - 1) / 3; few > 0 && few < m - 1; few = few * 2 / 3) // 1.5 times as many are less than m
    EXPECT_GT(error_of(reduce_frame(c.frame, with_modes(few))), tolerance) << few << " do where " << m << " are taken";

  ASSERT_FALSE(model.statements.empty());
  EXPECT_NE(model.statements[0].find("keep the receptance of the interface up to"), std::string::npos)
      << model.statements[0];
  const double reported = std::stod(model.statements[0].substr(model.statements[0].find("within ") + 7)) / 100.;
  EXPECT_LE(found, 1.01 * reported) << model.statements[0];
  EXPECT_LE(reported, 1.01 * found + 0.2 * tolerance); // twice the doubt of the full frame's receptance that is allowed
  EXPECT_NE(model.statements[0].find("the rule of 3.5 times the highest frequency would take"), std::string::npos);
}
INSTANTIATE_TEST_SUITE_P(SupportedAndFree, ReceptanceNumber,
                         ::testing::Combine(::testing::Values(3e6, 0.), ::testing::Values(7, 14),
                                            ::testing::Values(0.05, 0.01, 0.003, 0.001, 1e-5)));

/// Of full matrices with dampers and a loss factor, by one complex factor each.
Receptances direct(const MatrixXd &M, const MatrixXd &B, const MatrixXd &C, const std::vector<int> &q1,
                   const std::vector<double> &omegas)
{
  Receptances result;
  for (const double omega : omegas)
  {
    const MatrixXcd D =
        std::complex<double>(1., 2. * zeta) * C - omega * omega * M + std::complex<double>(0., omega) * B;
    const auto n1   = Eigen::Index(q1.size());
    MatrixXcd  unit = MatrixXcd::Zero(D.rows(), n1);
    for (Eigen::Index i = 0; i < n1; ++i)
      unit(q1[i], i) = 1.;
    result.push_back(MatrixXcd(D.partialPivLu().solve(unit))(q1, Eigen::all));
  }
  return result;
}

/// omega b / c of the foundation at the highest frequency, and the tolerance.
using DampersInside = ::testing::TestWithParam<std::tuple<double, double>>;

TEST_P(DampersInside, AreMetByTheirStaticShapesHoweverStrong)
{
  const auto [strength, tolerance] = GetParam();
  Lattice lattice;
  lattice.nx = 6, lattice.ny = 3, lattice.nz = 7;
  const VectorXd undamped = dense_modes(frame_of(lattice).C, frame_of(lattice).M).omega;
  const double   highest  = 0.5 * (undamped(9) + undamped(10));
  lattice.damper          = strength * lattice.foundation / highest;
  auto frame              = frame_of(lattice);

  std::vector<double> omegas;
  for (int i = 1; i <= 40; ++i)
    omegas.push_back(highest * i / 40.);
  for (int j = 0; j <= 9; ++j)
    omegas.push_back(undamped(j));
  const auto                 q1    = frame.interface_coordinates();
  const auto                 exact = direct(frame.M, frame.B, frame.C, q1, omegas);
  coupling::ReductionOptions options;
  options.frequency = highest / two_pi;
  options.tolerance = tolerance;
  std::vector<int> first(q1.size());
  std::iota(first.begin(), first.end(), 0);
  const auto error_of = [&](const MatrixXd &M, const MatrixXd &B, const MatrixXd &C)
  {
    const VectorXd scale = M.diagonal().head(first.size()).cwiseSqrt();
    return error(direct(M, B, C, first, omegas), exact, scale);
  };
  const auto   model = reduce_frame(frame, options);
  const double found = error_of(model.M, model.B, model.C);
  ASSERT_FALSE(model.statements.empty());
  const double reported = std::stod(model.statements[0].substr(model.statements[0].find("within ") + 7)) / 100.;
  frame.B.setZero();
  const auto     without = reduce_with_basis(frame, options);
  const MatrixXd B       = without.basis.T.transpose() * (frame_of(lattice).B * without.basis.T);
  if (strength > 1.)
  {
    EXPECT_GT(error_of(without.frame.M, B, without.frame.C), 5. * tolerance) << "dampers are not felt";
  }
  EXPECT_LE(found, tolerance) << model.statements[0];
  EXPECT_LE(found, 1.05 * reported) << model.statements[0]; // the grids differ, and 9.4e-6 is told as 0.00094 %
  EXPECT_LE(reported, tolerance);
}
INSTANTIATE_TEST_SUITE_P(WeakAndStrong, DampersInside,
                         ::testing::Combine(::testing::Values(0.2, 2., 20., 200.), ::testing::Values(0.01, 1e-3)));

/// Whether the inside has coordinates without mass, and omega b / c of the foundation at the highest frequency.
using FewCoordinates = ::testing::TestWithParam<std::tuple<bool, double>>;

TEST_P(FewCoordinates, AreMetBeyondTheirHighestMode)
{
  const auto [massless, strength] = GetParam();
  Lattice lattice;
  lattice.nx = 4, lattice.ny = 3, lattice.nz = 3;
  const double highest = two_pi * 2000.;
  lattice.damper       = strength * lattice.foundation / highest;
  auto frame           = frame_of(lattice);
  frame.interfaces     = {test::interface_at("table", lattice.point(1, 1, 2), lattice.point(3, 2, 2))};
  if (massless)
    for (int i = 0; i < 30; i += 2)
      frame.M.coeffRef(i, i) = 0.;
  coupling::ReductionOptions options;
  options.frequency = highest / two_pi;
  const auto model  = reduce_frame(frame, options);
  ASSERT_LT(model.omega0(model.omega0.size() - 1), highest) << "or the test shows nothing";

  std::vector<double> omegas;
  for (int i = 1; i <= 100; ++i)
    omegas.push_back(highest * i / 100.);
  std::vector<int> first(model.n_interface);
  std::iota(first.begin(), first.end(), 0);
  const VectorXd scale = model.M.diagonal().head(model.n_interface).cwiseSqrt();
  const auto     exact = direct(frame.M, frame.B, frame.C, frame.interface_coordinates(), omegas);
  const double   found = error(direct(model.M, model.B, model.C, first, omegas), exact, scale);
  if (massless && strength > 1.) // no coordinate could carry what dampers do there: modes must have mass
  {
    ASSERT_EQ(model.notes.size(), 1u);
    EXPECT_NE(model.notes[0].find("dampers act where the frame has no mass"), std::string::npos) << model.notes[0];
    const double reported = std::stod(model.notes[0].substr(model.notes[0].find("within ") + 7)) / 100.;
    EXPECT_LE(found, 1.05 * reported) << model.notes[0]; // the grids differ
    EXPECT_LE(reported, 2. * found) << "dampers within the inside are left out of the estimate, and would lower it";
    return;
  }
  ASSERT_FALSE(model.statements.empty());
  EXPECT_LE(found, options.tolerance) << model.statements[0];
}
INSTANTIATE_TEST_SUITE_P(DampedOrNot, FewCoordinates,
                         ::testing::Combine(::testing::Bool(), ::testing::Values(0., 0.5, 20.)));

TEST(ReceptanceEstimate, IsTheTrueErrorOfAGivenNumberOfModes)
{
  const Case c     = make_case(3e6, 10);
  const auto exact = by_modes(c.frame.C, c.frame.M, c.frame.interface_coordinates(), c.omegas, Damping::loss_factor);
  for (const int m : {25, 40, 60})
  {
    auto options         = with_modes(m);
    options.frequency    = c.highest_hz;
    const auto     model = reduce_frame(c.frame, options);
    const VectorXd scale = model.M.diagonal().head(model.n_interface).cwiseSqrt();
    ASSERT_FALSE(model.statements.empty());
    const auto       at       = model.statements[0].find("within ");
    const double     reported = std::stod(model.statements[0].substr(at + 7)) / 100.;
    std::vector<int> first(model.n_interface);
    std::iota(first.begin(), first.end(), 0);
    const double found = error(by_modes(model.C, model.M, first, c.omegas, Damping::loss_factor), exact, scale);
    EXPECT_NEAR(reported, found, 0.1 * found) << m; // the grids of frequencies differ

    double worst = 0.; // of the interfaces by themselves, six coordinates each
    for (const int at : {0, 6})
    {
      const std::vector<int> own = {at, at + 1, at + 2, at + 3, at + 4, at + 5};
      Receptances            H, full;
      for (const MatrixXcd &of_all : by_modes(model.C, model.M, first, c.omegas, Damping::loss_factor))
        H.emplace_back(of_all(own, own));
      for (const MatrixXcd &of_all : exact)
        full.emplace_back(of_all(own, own));
      worst = std::max(worst, error(H, full, scale.segment(at, 6)));
    }
    const auto by_itself = model.statements[0].find("by itself ");
    ASSERT_NE(by_itself, std::string::npos) << model.statements[0];
    EXPECT_NEAR(std::stod(model.statements[0].substr(by_itself + 10)) / 100., worst, 0.15 * worst)
        << model.statements[0];
  }
}

TEST(ReceptanceEstimate, BeyondTheModesThatAreKnownIsAWarning)
{
  const Case c       = make_case(3e6, 10);
  auto       options = with_modes(2);
  options.frequency  = c.highest_hz;
  const auto model   = reduce_frame(c.frame, options);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_EQ(model.notes[0].find("reduction: the highest of the 2 retained fixed-interface modes has "), 0u)
      << model.notes[0];
  const double reported = std::stod(model.notes[0].substr(model.notes[0].find("has ") + 4));
  EXPECT_NEAR(reported, model.omega0[1] / (2. * M_PI), 1e-2 * reported) << "rounded";
  EXPECT_NE(model.notes[0].find("request more modes"), std::string::npos);

  EXPECT_NE(reduce_frame(c.frame,
                         [&]
                         {
                           auto none    = options;
                           none.n_modes = 0;
                           return none;
                         }())
                .notes[0]
                .find("no fixed-interface modes are retained"),
            std::string::npos);
  options.n_modes = 40;
  EXPECT_TRUE(reduce_frame(c.frame, options).notes.empty());
}

} // namespace
} // namespace gestell

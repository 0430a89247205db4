#include "coupling/reduction/reduce_frame.h"

#include "coupling/algebra/dense_modes.h"
#include "fem/values/two_pi.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/lattice.h"
#include "tests/support/test.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace gestell
{
namespace
{

using coupling::dense_modes;
using coupling::reduce_frame;
using coupling::ReducedFrame;
using coupling::ReductionOptions;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::frame_of;
using test::Lattice;
using test::with_modes;

int internal_coordinates(const fem::FrameMatrices &frame)
{
  return int(frame.M.rows() - frame.interface_coordinates().size());
}

VectorXd full_frequencies(const fem::FrameMatrices &frame)
{
  return dense_modes(frame.C, frame.M).omega;
}

/// H(omega) = (C + i omega B - omega^2 M)^-1 on the leading coordinates given.
Eigen::MatrixXcd receptance(const MatrixXd &M, const MatrixXd &B, const MatrixXd &C, double omega,
                            const std::vector<int> &at)
{
  const Eigen::MatrixXcd Z = (C - omega * omega * M).cast<std::complex<double>>() + std::complex<double>(0., omega) * B;
  Eigen::MatrixXcd       loads = Eigen::MatrixXcd::Zero(M.rows(), at.size());
  for (std::size_t k = 0; k < at.size(); ++k)
    loads(at[k], k) = 1.;
  return Eigen::MatrixXcd(Z.partialPivLu().solve(loads))(at, Eigen::all);
}

std::vector<int> first(int n)
{
  std::vector<int> index(n);
  for (int i = 0; i < n; ++i)
    index[i] = i;
  return index;
}

TEST(CraigBampton, WithAllModesIsTheFullModel)
{
  const auto frame   = frame_of(Lattice());
  const auto reduced = reduce_frame(frame, with_modes(internal_coordinates(frame)));

  const VectorXd exact = full_frequencies(frame);
  const VectorXd found = dense_modes(reduced.C, reduced.M).omega;
  ASSERT_EQ(found.size(), exact.size());
  EXPECT_LT((found - exact).cwiseQuotient(exact).cwiseAbs().maxCoeff(), 1e-9); // a change of basis: rounding only

  const double omega = 0.7 * (exact(4) + exact(5));
  const auto   full  = receptance(frame.M, frame.B, frame.C, omega, frame.interface_coordinates());
  const auto   small = receptance(reduced.M, reduced.B, reduced.C, omega, first(reduced.n_interface));
  EXPECT_LT((full - small).norm(), 1e-8 * full.norm());
}

TEST(CraigBampton, FrequenciesComeFromAboveAndFallWithTheNumberOfModes)
{
  const auto     frame    = frame_of(Lattice());
  const VectorXd exact    = full_frequencies(frame);
  VectorXd       previous = VectorXd::Constant(12, INFINITY);
  for (const int m : {0, 3, 8, 20, 60})
  {
    const auto     reduced = reduce_frame(frame, with_modes(m));
    const VectorXd omega   = dense_modes(reduced.C, reduced.M).omega.head(12);
    for (int j = 0; j < 12; ++j) // min-max principle; 1e-10 for rounding
    {
      EXPECT_GE(omega(j), exact(j) * (1. - 1e-10)) << "mode " << j << " with " << m;
      EXPECT_LE(omega(j), previous(j) * (1. + 1e-10)) << "mode " << j << " with " << m;
    }
    previous = omega;
  }
}

TEST(CraigBampton, StaticDeflectionUnderInterfaceLoadsIsExactForAnyNumberOfModes)
{
  const auto     frame = frame_of(Lattice());
  const auto     q1    = frame.interface_coordinates();
  const VectorXd load  = VectorXd::LinSpaced(q1.size(), -1., 2.);
  VectorXd       f     = VectorXd::Zero(frame.C.rows());
  f(q1)                = load;
  const VectorXd exact = MatrixXd(frame.C).llt().solve(f);
  for (const int m : {0, 1, 7})
  {
    const auto basis       = test::basis_with_modes(frame, m);
    const auto reduced     = reduce_frame(frame, with_modes(m));
    VectorXd   load_p      = VectorXd::Zero(reduced.C.rows());
    load_p.head(q1.size()) = load;
    const VectorXd q       = basis.T * reduced.C.llt().solve(load_p);
    EXPECT_LT((q - exact).norm(), 1e-10 * exact.norm()) << m << " modes";
  }
}

TEST(CraigBampton, BlocksAreTheProductsWithT)
{
  const auto     frame = frame_of(Lattice());
  const auto     basis = test::basis_with_modes(frame, 9);
  const auto     star  = coupling::reduced_matrices(basis, frame.B);
  const MatrixXd T     = basis.T;
  const auto     close = [&](const MatrixXd &block, const MatrixXd &product)
  { return (block - product).norm() < 1e-10 * product.norm(); };
  EXPECT_TRUE(close(star.M, T.transpose() * frame.M * T));
  EXPECT_TRUE(close(star.B, T.transpose() * frame.B * T));
  EXPECT_TRUE(close(star.C, T.transpose() * frame.C * T));
}

TEST(CraigBampton, LeavesInterfaceCoordinatesPhysical)
{
  const auto frame   = frame_of(Lattice());
  const auto basis   = test::basis_with_modes(frame, 5);
  const auto reduced = reduce_frame(frame, with_modes(5));
  for (std::size_t k = 0; k < frame.interfaces.size(); ++k)
    for (int d = 0; d < 6; ++d)
    {
      const int i = frame.interfaces[k].coordinate[d], p = reduced.interfaces[k].coordinate[d];
      EXPECT_EQ((basis.T.row(i) - VectorXd::Unit(basis.T.cols(), p).transpose()).norm(), 0.);
    }
}

/// Forces under velocities and accelerations: support_forces_test.cc.
TEST(CraigBampton, RowsOfOutputsPicturesAndGravityAreTheFullOnesTimesT)
{
  const auto frame   = frame_of(Lattice());
  const auto basis   = test::basis_with_modes(frame, 5);
  const auto reduced = reduce_frame(frame, with_modes(5));
  EXPECT_LT((reduced.outputs.at(0).on_q - basis.T.transpose() * frame.outputs[0].on_q).norm(),
            1e-12 * reduced.outputs[0].on_q.norm());
  EXPECT_LT((reduced.displacement.cast<double>() - frame.picture.displacement * basis.T).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((reduced.translations_load - basis.T.transpose() * frame.M * frame.translations).norm(),
            1e-12 * reduced.translations_load.norm());
}

/// However many modes are asked for: up to the limit no frequency is wrong by more than the tolerance (a tenth of it
/// for the estimate), and none is missing.
TEST(CraigBampton, OfANumberOfModesHoldsUpToItsLimit)
{
  for (const double foundation : {3e6, 3e5})
  {
    Lattice lattice;
    lattice.foundation    = foundation;
    const auto     frame  = frame_of(lattice);
    const VectorXd exact  = full_frequencies(frame) / two_pi;
    double         before = 0.;
    for (const int n_modes : {0, 1, 2, 3, 5, 8, 13, 21})
    {
      SCOPED_TRACE(n_modes);
      ReductionOptions options;
      options.n_modes            = n_modes;
      const ReducedFrame reduced = reduce_frame(frame, options);
      const double       limit   = reduced.frequency_limit_hz;
      EXPECT_GT(limit, 0.);
      for (int j = 0; j < exact.size() && exact(j) <= limit; ++j)
      {
        ASSERT_LT(j, reduced.frequencies_hz.size());
        EXPECT_LE(reduced.frequencies_hz(j), (1. + 1.1 * options.tolerance) * exact(j)) << j;
      }
      EXPECT_GE(limit, before * (1. - 1e-3)) << "more modes hold no less";
      before = limit;
    }
  }
}

} // namespace
} // namespace gestell

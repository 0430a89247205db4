// The inside of a frame by modes with the interface free, and by its deflection under the inertia of rigid motions.

#include "coupling/algebra/dense_modes.h"
#include "coupling/reduction/reduce_frame.h"
#include "coupling/reduction/shapes/free_interface_modes.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/cube.h"
#include "tests/support/lattice.h"
#include "tests/support/test.h"

#include <Eigen/Cholesky>

namespace gestell::test
{
namespace
{

using coupling::ReductionOptions;
using Eigen::MatrixXd;
using Eigen::VectorXd;

fem::FrameMatrices floating(int nx = 5, int ny = 3, int nz = 6)
{
  Lattice lattice;
  lattice.nx               = nx;
  lattice.ny               = ny;
  lattice.nz               = nz;
  lattice.foundation       = 0.;
  lattice.damper           = 0.;
  fem::FrameMatrices frame = frame_of(lattice);
  frame.B.setZero();
  frame.C.prune(0.);
  frame.C.makeCompressed();
  return frame;
}

ReductionOptions inside(const std::string &method, int n_modes, bool inertia_relief = false)
{
  ReductionOptions options;
  options.n_modes        = n_modes;
  options.method         = method;
  options.inertia_relief = inertia_relief;
  return options;
}

double largest_frequency_error(const fem::FrameMatrices &frame, const coupling::ReducedFrame &reduced, int n_rigid,
                               int count)
{
  const VectorXd full  = coupling::dense_modes(MatrixXd(frame.C), MatrixXd(frame.M)).omega / (2. * M_PI);
  double         error = 0.;
  for (int j = n_rigid; j < n_rigid + count; ++j)
    error = std::max(error, std::abs(reduced.frequencies_hz[j] / full[j] - 1.));
  return error;
}

std::string statements_of(const coupling::ReducedFrame &reduced)
{
  std::string all;
  for (const std::string &statement : reduced.statements)
    all += statement + '\n';
  return all;
}

TEST(FreeInterfaceModes, GiveTheFrequenciesOfTheFullFrame)
{
  // 270 coordinates are solved densely, 756 by Krylov's space; the residual allowed there is 1e-10.
  for (const auto &frame : {floating(), floating(7, 4, 9)})
  {
    const auto free = coupling::reduce_frame(frame, inside("free-interface", 10));
    EXPECT_EQ((free.frequencies_hz.array() == 0.).count(), 6);
    EXPECT_LT(largest_frequency_error(frame, free, 6, 10), 1e-8);
    const auto held = coupling::reduce_frame(frame, inside("craig-bampton", 10));
    EXPECT_GT(largest_frequency_error(frame, held, 6, 10), 1e-4) << "or the test shows nothing";
  }
}

TEST(FreeInterfaceModes, WithoutANumberReachHalfAgainBeyondTheHighestFrequencyOfInterest)
{
  const auto       frame   = floating(7, 4, 9);
  const VectorXd   full    = coupling::dense_modes(MatrixXd(frame.C), MatrixXd(frame.M)).omega / (2. * M_PI);
  ReductionOptions options = inside("free-interface", -1);
  options.frequency        = 1.01 * full[6 + 7]; // the eighth elastic one
  const auto reduced       = coupling::reduce_frame(frame, options);
  const auto expected      = (full.array() <= 1.5 * options.frequency).count() - 6;
  EXPECT_EQ(reduced.omega0.size(), expected);
  EXPECT_LT(largest_frequency_error(frame, reduced, 6, 8), 1e-8);
}

TEST(FreeInterfaceModes, GiveAnErrorOfTheRetainedModesAlone)
{
  for (const bool is_floating : {true, false})
  {
    const auto frame   = is_floating ? floating() : frame_of(Lattice());
    const int  n_rigid = is_floating ? 6 : 0, kept = 10;
    const auto reduced = coupling::reduce_frame(frame, inside("free-interface", kept));
    EXPECT_LT(largest_frequency_error(frame, reduced, n_rigid, kept), 1e-8);
    ASSERT_EQ(reduced.frequency_error.size(), 12 + kept);
    for (int j = 0; j < reduced.frequency_error.size(); ++j)
      if (j < n_rigid + kept)
        EXPECT_EQ(reduced.frequency_error[j], 0.) << j;
      else
        EXPECT_TRUE(std::isnan(reduced.frequency_error[j])) << j << ": beyond the modes kept nothing is known";
    EXPECT_LE(reduced.frequency_limit_hz, reduced.frequencies_hz[n_rigid + kept - 1] * (1. + 1e-8));
  }
}

TEST(FreeInterfaceModes, AreCountedByInertiaBesideRigidMotions)
{
  for (const auto &frame : {floating(7, 4, 9), frame_of(Lattice{7, 4, 9})})
  {
    const auto reduced = coupling::reduce_frame(frame, inside("free-interface", 10));
    EXPECT_NE(statements_of(reduced).find("elastic modes with the interface free below it, and all of them are found"),
              std::string::npos)
        << statements_of(reduced);
  }
}

/// Single vectors pass over the repeated frequencies of a cube; the inertia with nothing held tells.
TEST(FreeInterfaceModes, SkippedAreCountedSearchedForAndFound)
{
  fem::FrameMatrices frame;
  frame.C          = cube_stiffness(9);
  frame.M          = unit_mass(729);
  frame.B          = 0. * frame.M;
  frame.interfaces = {{"corner", {}, {0, -1, -1, -1, -1, -1}, {1., 1., 1., 1., 1., 1.}}};
  const auto exact = cube_frequencies(9);

  const auto                      basis = test::basis_with_modes(frame, 0);
  coupling::FixedInterfaceFrame   held(frame, {0});
  coupling::BlockLanczos::Options options;
  options.block = 1;
  coupling::FreeInterfaceModes modes(held, basis, frame, options);
  const auto                   largest_error = [&]
  {
    const VectorXd omega = modes.lowest(20).omega;
    double         error = 0.;
    for (int j = 0; j < 20; ++j)
      error = std::max(error, std::abs(omega[j] / exact[j] - 1.));
    return error;
  };
  modes.find(20);
  modes.finish();
  EXPECT_GT(largest_error(), 1e-3) << "or the test shows nothing";
  EXPECT_FALSE(modes.confirm());
  modes.find(20);
  EXPECT_LT(largest_error(), 1e-10);
  modes.finish();
  EXPECT_TRUE(modes.confirm());
}

TEST(InnerShapes, KeepUnitMassAndDiagonalStiffness)
{
  const auto frame = floating();
  for (const auto &options : {inside("free-interface", 6, true), inside("craig-bampton", 6, true)})
  {
    const auto      reduced = coupling::reduce_with_basis(frame, options);
    const MatrixXd &T       = reduced.basis.T;
    const MatrixXd  M = T.transpose() * frame.M * T, C = T.transpose() * frame.C * T;
    EXPECT_EQ(T.cols(), 12 + 6 + 6);
    EXPECT_LT((M - reduced.frame.M).norm(), 1e-10 * M.norm());
    EXPECT_LT((C - reduced.frame.C).norm(), 1e-10 * C.norm());
  }
}

/// Deflection of a floating frame under loads that its inertia balances:
/// (C + (M R)(M R)^T) u = f - M R (R^T M R)^-1 R^T f, hence R^T M u = 0.
VectorXd relieved(const MatrixXd &C, const MatrixXd &M, const MatrixXd &R, const VectorXd &f)
{
  const MatrixXd MR       = M * R;
  const VectorXd balanced = f - MR * MatrixXd(R.transpose() * MR).ldlt().solve(R.transpose() * f);
  return MatrixXd(C + MR * MR.transpose()).ldlt().solve(balanced);
}

TEST(InertiaRelief, MakesStaticsOfAFloatingFrameExactWithoutAnyMode)
{
  const auto frame = floating();
  VectorXd   f     = VectorXd::Zero(frame.M.rows());
  for (const int i : frame.interface_coordinates())
    f[i] = 1000. * (1. + std::sin(double(i)));
  const VectorXd exact = relieved(frame.C, frame.M, frame.rigid_motions, f);

  const auto error = [&](const ReductionOptions &options)
  {
    const auto      reduced = coupling::reduce_with_basis(frame, options);
    const MatrixXd &T       = reduced.basis.T;
    // the rigid motions lie in the space of T: their coordinates are those of q1, and none of the modes
    MatrixXd R                    = MatrixXd::Zero(T.cols(), 6);
    R.topRows(reduced.basis.n1()) = frame.rigid_motions(reduced.basis.q1, Eigen::all);
    const VectorXd p              = relieved(reduced.frame.C, reduced.frame.M, R, T.transpose() * f);
    return (T * p - exact).norm() / exact.norm();
  };
  EXPECT_LT(error(inside("craig-bampton", 0, true)), 1e-9);
  EXPECT_LT(error(inside("free-interface", 3, true)), 1e-9);
  EXPECT_GT(error(inside("craig-bampton", 0)), 1e-3);
}

TEST(InertiaRelief, CarriesTheWeightOfASupportedFrame)
{
  const auto frame = frame_of(Lattice());
  EXPECT_GT(coupling::reduce_frame(frame, inside("craig-bampton", 5)).static_residual, 0.01);
  // the square root of what rounding leaves of one
  EXPECT_LT(coupling::reduce_frame(frame, inside("craig-bampton", 5, true)).static_residual, 1e-6);
}

} // namespace
} // namespace gestell::test

#include "coupling/algebra/dense_modes.h"
#include "coupling/reduction/modal_damping.h"
#include "coupling/reduction/reduce_frame.h"
#include "coupling/reduction/shapes/reduction_basis.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/lattice.h"
#include "tests/support/test.h"

#include <Eigen/Cholesky>

namespace gestell
{
namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::frame_of;
using test::Lattice;

TEST(InitialValues, OfAMotionInTheReducedSpaceAreItsCoordinates)
{
  const auto     frame = frame_of(Lattice());
  const auto     basis = test::basis_with_modes(frame, 7);
  const VectorXd p     = VectorXd::LinSpaced(basis.T.cols(), -1., 2.);
  EXPECT_LT((coupling::project_initial(basis, frame.C, basis.T * p) - p).norm(), 1e-10 * p.norm());
}

TEST(InitialValues, FollowTheBlocksOfTheFormula)
{
  const auto       frame = frame_of(Lattice());
  const auto       basis = test::basis_with_modes(frame, 7);
  const int        n     = int(frame.C.rows());
  std::vector<int> q2;
  for (int i = 0; i < n; ++i)
    if (!std::binary_search(basis.q1.begin(), basis.q1.end(), i))
      q2.push_back(i);
  VectorXd q(n);
  for (int i = 0; i < n; ++i)
    q(i) = std::sin(1.3 * i * i);

  const MatrixXd C = frame.C, V22 = basis.T.rightCols(7)(q2, Eigen::all);
  const VectorXd expected = basis.omega0.cwiseAbs2().cwiseInverse().asDiagonal() *
                            (V22.transpose() * C(q2, basis.q1) * q(basis.q1) + V22.transpose() * C(q2, q2) * q(q2));
  const VectorXd p = coupling::project_initial(basis, frame.C, q);
  EXPECT_EQ(p.head(basis.n1()), q(basis.q1));
  EXPECT_LT((p.tail(7) - expected).norm(), 1e-10 * expected.norm());
}

TEST(InitialValues, LeaveTheLeastEnergyInWhatTheModelCannotShow)
{
  const auto frame = frame_of(Lattice());
  const auto basis = test::basis_with_modes(frame, 7);
  VectorXd   q(frame.C.rows());
  for (int i = 0; i < q.size(); ++i)
    q(i) = std::sin(1.3 * i * i);
  const VectorXd p    = coupling::project_initial(basis, frame.C, q);
  const VectorXd rest = q - basis.T * p;
  // orthogonal, in energy, to every motion of the modes
  EXPECT_LT((basis.T.rightCols(7).transpose() * (frame.C * rest)).norm(), 1e-9 * (frame.C * q).norm());
}

/// 1200 coordinates: too many for the dense way, so that block Lanczos does the work.
fem::FrameMatrices large_frame()
{
  Lattice lattice;
  lattice.nx = 10, lattice.ny = 4, lattice.nz = 10;
  return frame_of(lattice);
}

TEST(FixedInterfaceModes, AreOrthonormalAndZeroOnTheInterface)
{
  const auto     frame = large_frame();
  const auto     basis = test::basis_with_modes(frame, 30);
  const MatrixXd V     = basis.fixed_modes();
  EXPECT_LT((V.transpose() * frame.M * V - MatrixXd::Identity(30, 30)).cwiseAbs().maxCoeff(), 1e-9);
  const MatrixXd C = V.transpose() * frame.C * V;
  EXPECT_LT((C - MatrixXd(basis.omega0.cwiseAbs2().asDiagonal())).cwiseAbs().maxCoeff(),
            1e-7 * basis.omega0.cwiseAbs2().maxCoeff());
  EXPECT_EQ(V(basis.q1, Eigen::all).cwiseAbs().maxCoeff(), 0.);
}

TEST(FixedInterfaceModes, FoundInTwoBatchesAreThoseFoundInOne)
{
  const auto                 frame   = large_frame();
  const auto                 at_once = test::basis_with_modes(frame, 45);
  coupling::ReductionOptions options;
  options.tolerance  = 1e-4; // needs more than the first thirty
  const auto reduced = reduce_frame(frame, options);
  const int  m       = std::min<int>(45, reduced.omega0.size());
  ASSERT_GT(m, 30);
  for (int j = 0; j < m; ++j)
    EXPECT_NEAR(reduced.omega0(j) / at_once.omega0(j), 1., 1e-9);
}

TEST(RefinedModes, OfALargeFrameAreThoseOfTheDenseMatrices)
{
  auto       frame          = large_frame();
  const auto exact          = coupling::dense_modes(MatrixXd(frame.C), MatrixXd(frame.M));
  frame.modal_damping_ratio = 0.5; // then d = omega
  coupling::add_modal_damping(frame, 10);
  for (int j = 0; j < 10; ++j)
    EXPECT_NEAR(frame.modal_damping.d(j) / exact.omega(j), 1., 1e-8);
}

} // namespace
} // namespace gestell

#include "coupling/reduction/shapes/reduction_basis.h"

#include "coupling/reduction/reduce_frame.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/lattice.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>

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

} // namespace
} // namespace gestell

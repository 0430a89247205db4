#include "fem/assembly/affine_constraints.h"
#include "tests/support/box_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gestell::test
{

namespace
{

using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(AffineConstraints, FollowTiesToFreeDisplacements)
{
  fem::MultipointConstraints constraints(3);
  constraints.held[1] = 1;
  constraints.tie(3, {{0, 0.5}, {1, 7.}}); // u3 = u0 / 2, as u1 is held
  constraints.tie(6, {{3, 4.}, {2, 1.}});  // u6 = 2 u0 + u2
  constraints.tie(7, {{1, 3.}});           // u7 = 0
  const fem::AffineConstraints affine(constraints);
  Eigen::VectorXd              u(9);
  u << 1., 0., 10., 0.5, 4., 5., 12., 0., 8.;
  Eigen::VectorXd q(5);
  q << 1., 10., 4., 5., 8.;
  EXPECT_LT((affine.expand(q) - u).norm(), 1e-14);
  EXPECT_THAT(affine.row(7), IsEmpty());
}

TEST(AffineConstraints, ThatLeadBackToThemselvesAreRefused)
{
  fem::MultipointConstraints constraints(2);
  constraints.tie(0, {{3, 1.}});
  constraints.tie(3, {{4, 1.}});
  constraints.tie(4, {{0, 1.}});
  EXPECT_THAT(refusal([&] { fem::AffineConstraints{constraints}; }), HasSubstr("tied to itself"));
}

} // namespace

} // namespace gestell::test

// The laws by which a search jumps to the next model, and frames of the first modes of a reduction.

#include "apps/sizing/first_modes.h"
#include "apps/sizing/size_laws.h"
#include "coupling/plugin/frame_service_loader.h"
#include "tests/support/test.h"

#include <Eigen/Cholesky>

namespace gestell::tests
{
namespace
{

using namespace apps;

constexpr double coarsest = 2.25, aim = 0.8;

/// Of one output, whose error falls like h^q.
MeshPoint point(double size, double error, double q, double r, double sides = 0.)
{
  return {size, 1e4 * std::pow(size, -r), 1., {{sides, error * std::pow(size, q), 0., 0.}}};
}

TEST(SizeLaws, FindTheMeshThatTwoPointsForetell)
{
  for (const double q : {1.2, 2., 3.5})
    for (const double r : {1.5, 2.5})
    {
      const std::vector<Shares> others = {{0., 0., 0.1, 0.05}};
      const auto next = coarsest_within(aim, {point(2., 3., q, r), point(1.2, 3., q, r)}, others, coarsest);
      ASSERT_TRUE(next);
      const double size = std::pow((aim - 0.15) / 3., 1. / q);
      EXPECT_NEAR(next->size, size, 1e-6 * size) << q;
      EXPECT_NEAR(next->coordinates, 1e4 * std::pow(size, -r), 1. / size) << r;
    }
}

/// One point shows no law: the next mesh is at most twice as fine.  None is coarser than the coarsest.
TEST(SizeLaws, StayWithinWhatIsKnown)
{
  const std::vector<Shares> none = {{}};
  EXPECT_NEAR(coarsest_within(aim, {point(2., 100., 1., 2.)}, none, coarsest)->size, 1., 1e-12);
  EXPECT_EQ(coarsest_within(aim, {point(2., 1e-9, 2., 2.)}, none, coarsest)->size, coarsest);
}

/// What straight sides leave falls with no finer mesh.
TEST(SizeLaws, GiveUpWhereStraightSidesAloneAreTooMuch)
{
  const std::vector<Shares> none    = {{}};
  constexpr double          unknown = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(coarsest_within(aim, {point(2., 1., 2., 2., 0.9)}, none, coarsest));
  EXPECT_FALSE(coarsest_within(aim, {point(2., 1., 2., 2., unknown)}, none, coarsest));
  EXPECT_TRUE(coarsest_within(aim, {point(2., 1., 2., 2., 0.5)}, none, coarsest));
  EXPECT_LT(coarsest_within(aim, {point(2., unknown, 2., 2.)}, none, coarsest)->size, 2.); // the error is seen there
}

TEST(SizeLaws, TakeMoreModesByTheSquareOfTheirNumber)
{
  EXPECT_EQ(modes_for(0.2, 8, 0.8), 16);
  EXPECT_EQ(modes_for(0.2, 8, 0.21), 12);
  EXPECT_EQ(modes_for(0.2, 0, std::numeric_limits<double>::infinity()), 2);
}

/// A rod held at both ends under uniform inertia, u = x (1 - x)/2 = sum_odd 4/(pi j)^3 sin(pi j x): displacements,
/// their energy, which is the mean square of the stress, and the forces at its ends, by m modes.  Factors times
/// differences are the errors, or somewhat more as differences in the mean are orthogonal.
TEST(SizeLaws, ContainWhatModesBeyondTheFinerReductionLeave)
{
  constexpr int all = 200000;
  struct Law
  {
    double falls, power, most;
  };
  for (const Law law : {Law{4., truncation_power(true, false), 1.6}, Law{4., truncation_power(false, false), 1.06}})
    for (const int m : {3, 6, 10, 21})
    {
      const bool stress = law.power == 1.5;
      const int  finer  = std::max(2 * m, m + 8);
      const auto tail   = [&](int from, int to)
      {
        double sum = 0.;
        for (int j = from + 1; j <= to; ++j)
          sum += j % 2 == 1 ? std::pow(j, -law.falls) : 0.;
        return stress ? std::sqrt(sum) : sum;
      };
      const double factor  = truncation_factor(Eigen::VectorXd::LinSpaced(finer, M_PI, M_PI * finer), m, law.power);
      const double printed = factor * tail(m, finer), error = tail(m, all);
      EXPECT_GE(printed, 0.999 * error) << m << ' ' << law.power;
      EXPECT_LE(printed, law.most * error) << m << ' ' << law.power;
      EXPECT_GT(factor, 1.);
    }
  EXPECT_EQ(truncation_factor(Eigen::VectorXd::LinSpaced(6, 1., 6.), 6, 3.), 1.) << "no more modes";
}

/// A rod of masses with a row for a force, under its weight along itself.
fem::FrameMatrices weighing_rod(int n)
{
  fem::FrameMatrices frame;
  frame.M.resize(n, n);
  frame.C.resize(n, n);
  frame.B.resize(n, n);
  for (int i = 0; i < n; ++i)
  {
    frame.M.insert(i, i) = 0.2 + 0.01 * i;
    frame.B.insert(i, i) = 0.3;
    frame.C.insert(i, i) = i + 1 < n ? 2e4 : 1e4;
    if (i > 0)
      frame.C.insert(i, i - 1) = -1e4;
    if (i + 1 < n)
      frame.C.insert(i, i + 1) = -1e4;
  }
  for (fem::SparseMatrix *A : {&frame.M, &frame.B, &frame.C})
    A->makeCompressed();
  fem::Interface tip;
  tip.name          = "tip";
  tip.coordinate[0] = n - 1;
  frame.interfaces  = {tip};
  frame.translations.setZero(n, 3);
  frame.translations.col(0).setOnes();
  fem::FrameOutput root;
  root.name     = "root";
  root.unit     = "N";
  root.on_q     = Eigen::VectorXd::Unit(n, 0) * 1e4;
  root.on_v     = Eigen::VectorXd::Zero(n);
  frame.outputs = {root};
  return frame;
}

/// Matrices and rows are those of the reduction with as few modes, that under the weight too.
TEST(FirstModes, AreTheReductionWithAsFew)
{
  coupling::ReductionOptions options;
  options.n_modes                    = 12;
  const fem::FrameMatrices     frame = weighing_rod(30);
  const coupling::ReducedFrame many  = coupling::frame_service().reduce(frame, options, {});
  for (const int n_modes : {0, 3, 6, 12})
  {
    options.n_modes                     = n_modes;
    const coupling::ReducedFrame few    = coupling::frame_service().reduce(frame, options, {});
    const coupling::ReducedFrame firsts = with_first_modes(many, n_modes);
    // Signs of modes are free.
    for (const auto &[A, B] :
         {std::pair(&few.M, &firsts.M), std::pair(&few.B, &firsts.B), std::pair(&few.C, &firsts.C)})
    {
      ASSERT_EQ(A->rows(), B->rows());
      EXPECT_LT((A->cwiseAbs() - B->cwiseAbs()).norm(), 1e-7 * A->norm());
    }
    const fem::FrameOutput &a = few.outputs.at(0), &b = firsts.outputs.at(0);
    EXPECT_LT((a.on_q.cwiseAbs() - b.on_q.cwiseAbs()).norm(), 1e-7 * a.on_q.norm());
    ASSERT_EQ(a.on_a.size(), b.on_a.size());
    EXPECT_GT(a.on_a.norm(), 0.);
    EXPECT_LT((a.on_a.cwiseAbs() - b.on_a.cwiseAbs()).norm(), 1e-7 * a.on_a.norm());
    EXPECT_GT(a.on_v.norm(), 0.);
    EXPECT_LT((a.on_v.cwiseAbs() - b.on_v.cwiseAbs()).norm(), 1e-7 * a.on_v.norm());
    EXPECT_GT(a.under_acceleration.norm(), 0.);
    EXPECT_LT((a.under_acceleration - b.under_acceleration).norm(), 1e-7 * frame.M.sum());
  }
  EXPECT_THROW(with_first_modes(many, 13), std::invalid_argument);
}

/// The force at the root answers that at the tip, inertia and damping from outside, alpha M and ratios.
TEST(FirstModes, BalanceForcesWithDampingRatios)
{
  coupling::ReductionOptions options;
  options.n_modes          = 12;
  fem::FrameMatrices frame = weighing_rod(30);
  constexpr double   alpha = 2.;
  frame.B                  = alpha * frame.M;
  frame.B.makeCompressed();
  frame.modal_damping_ratio        = 0.05;
  const coupling::ReducedFrame all = coupling::frame_service().reduce(frame, options, {});
  const Eigen::VectorXd        R   = all.M.ldlt().solve(all.translations_load.col(0));
  for (const int n_modes : {0, 3, 12})
  {
    const coupling::ReducedFrame few = with_first_modes(all, n_modes);
    const Eigen::Index           n   = few.M.rows();
    const Eigen::VectorXd        p = 1e-3 * Eigen::VectorXd::Random(n), v = Eigen::VectorXd::Random(n);
    const Eigen::VectorXd        f        = 100. * Eigen::VectorXd::Unit(n, 0);
    const Eigen::VectorXd        a        = few.M.ldlt().solve(f - few.B * v - few.C * p);
    const Eigen::VectorXd        momentum = few.translations_load.col(0);
    const Eigen::VectorXd        damped   = alpha * momentum + ((all.B - alpha * all.M) * R).head(n);
    const fem::FrameOutput      &row      = few.outputs.at(0);
    const double                 terms = row.on_q.cwiseAbs().dot(p.cwiseAbs()) + row.on_v.cwiseAbs().dot(v.cwiseAbs()) +
                         row.on_a.cwiseAbs().dot(a.cwiseAbs());
    EXPECT_NEAR(row.on_q.dot(p) + row.on_v.dot(v) + row.on_a.dot(a), f[0] - momentum.dot(a) - damped.dot(v),
                1e-7 * terms)
        << n_modes << " modes";
  }
}

} // namespace
} // namespace gestell::tests

#include "coupling/periodic/branch_follower.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double least_pivot(const MatrixXd &J)
{
  const Eigen::PartialPivLU<MatrixXd> lu(J);
  double                              sign = lu.permutationP().determinant(), least = 1e300;
  for (Index i = 0; i < J.rows(); ++i)
  {
    const double pivot = lu.matrixLU()(i, i);
    sign *= pivot < 0. ? -1. : 1.;
    least = std::min(least, std::abs(pivot));
  }
  return sign * least;
}

} // namespace

BranchFollower::BranchFollower(BranchEquations &equations, double range, double tolerance)
    : equations_(equations), range_(range), tolerance_(tolerance)
{
}

void BranchFollower::grow_size(Point &point)
{
  const double norm = point.z.norm();
  if (!(norm > size_))
    return;
  if (size_ > 0.)
  {
    point.tangent.head(point.z.size()) *= size_ / norm;
    point.tangent.normalize();
  }
  size_ = norm;
}

void BranchFollower::size_from_rest(Point &point)
{
  const Index      m     = point.z.size();
  const VectorXd   way   = range_ * point.derivative.leftCols(m).partialPivLu().solve(point.derivative.col(m));
  constexpr double rests = 1e-9; // length of a motion at rest, of that at the end of the range
  if (!way.allFinite() || !(point.z.norm() <= rests * way.norm()))
    return;
  size_         = way.norm() > 0. ? way.norm() : 1.; // what grows by higher powers alone shows its size on the way
  point.tangent = VectorXd::Zero(m + 1);
  point.tangent << -way / size_, 1.;
  point.tangent.normalize();
}

void BranchFollower::refit(Point &point, bool at_parameter)
{
  constexpr int most_refits = 12; // meshes and harmonics grow by some ten per cent and more in each
  for (int k = 0; k < most_refits; ++k)
  {
    equations_.evaluate(point.z, point.lambda, false);
    MatrixXd Z(point.z.size(), 2);
    Z << point.z, point.tangent.head(point.z.size());
    if (!equations_.refit(point.solution, Z))
      return;
    Point start, fitted;
    start.tangent.resize(Z.rows() + 1);
    start.tangent << Z.col(1), point.tangent.tail(1);
    if (at_parameter)
      start.tangent << VectorXd::Zero(Z.rows()), 1.;
    start.tangent.normalize();
    if (!correct(Z.col(0), point.lambda, start.tangent, start, fitted) || !finish(start.tangent, fitted))
      throw ConvergenceFailure("the solution does not converge at " + std::to_string(point.lambda));
    fitted.iterations = point.iterations;
    point             = fitted;
  }
}

double BranchFollower::arclength(const Point &a, const Point &b) const
{
  const Index m = a.z.size();
  return a.tangent.head(m).dot(b.z - a.z) / size_ + a.tangent[m] * (b.lambda - a.lambda) / range_;
}

/// [F_z size, F_lambda range; last^T]
MatrixXd BranchFollower::bordered(const MatrixXd &derivative, const VectorXd &last) const
{
  const Index m = last.size() - 1;
  MatrixXd    A(m + 1, m + 1);
  A.topLeftCorner(m, m)  = derivative.leftCols(m) * size_;
  A.topRightCorner(m, 1) = derivative.col(m) * range_;
  A.bottomRows(1)        = last.transpose();
  return A;
}

MatrixXd BranchFollower::unscaled(const MatrixXd &bordered) const
{
  const Index m          = bordered.rows() - 1;
  MatrixXd    derivative = bordered.topRows(m);
  derivative.leftCols(m) /= size_;
  derivative.col(m) /= range_;
  return derivative;
}

/// Where the equations were evaluated with their jacobian; another lambda is what they were evaluated at then.
MatrixXd BranchFollower::derivative(const VectorXd &z, double lambda)
{
  const Index    m = z.size();
  const VectorXd F = equations_.residual();
  MatrixXd       D(m, m + 1);
  D.leftCols(m)           = equations_.jacobian();
  const double difference = equations_.parameter_difference();
  equations_.evaluate(z, lambda + difference * range_, false);
  D.col(m) = (equations_.residual() - F) / (difference * range_);
  return D;
}

/// Newton's method across `across` from the derivatives of `near`, where it has any.
bool BranchFollower::correct(VectorXd z, double lambda, const VectorXd &across, const Point &near, Point &point)
{
  const Index   m = z.size();
  MatrixXd      A = near.derivative.size() > 0 ? bordered(near.derivative, across) : MatrixXd();
  VectorXd      dx, r = VectorXd::Zero(m + 1);
  double        before = 0.;
  bool          fresh  = false; // the last step was by derivatives of its own begin
  int           moves = 0, last_move = 0;
  constexpr int most_corrections = 16; // Newton's take a few, chords twice as many
  for (point.iterations = 0; point.iterations - last_move < most_corrections; ++point.iterations)
  {
    equations_.evaluate(z, lambda, A.size() == 0);
    const VectorXd F    = equations_.residual();
    const double   here = equations_.closing();
    if (!F.allFinite())
      return false;
    constexpr int most_moves = 8; // a motion settles on its events in one or two
    if (VectorXd other = z; here <= tolerance_ && moves < most_moves && equations_.follow_motion(other))
    {
      r[m] -= across.head(m).dot(other - z) / size_; // back across it
      z = other;
      ++moves;
      last_move = point.iterations;
      dx.resize(0);
      continue;
    }
    constexpr double slow          = 0.5;  // contraction above which the derivatives are computed again
    constexpr double as_integrated = 1e-6; // closing error that jumps of fixed steps from grid to grid may leave
    const bool       moved         = dx.size() > 0;
    const bool       stalls        = moved && here > slow * before;
    if (here <= tolerance_ || (fresh && stalls && here <= as_integrated))
    {
      point.z          = z;
      point.lambda     = lambda;
      point.derivative = A.size() > 0 ? unscaled(A) : MatrixXd();
      return true;
    }
    if (A.size() > 0 && stalls)
    {
      equations_.evaluate(z, lambda, true);
      A.resize(0, 0);
    }
    fresh = A.size() == 0;
    if (fresh)
      A = bordered(derivative(z, lambda), across);
    else if (moved)
      A.topRows(m) += F * (dx.transpose() / dx.squaredNorm());
    r.head(m) = -F;
    dx        = A.partialPivLu().solve(r);
    r[m]      = 0.;
    if (!dx.allFinite())
      return false;
    z += size_ * dx.head(m);
    lambda += range_ * dx[m];
    before = here;
  }
  return false;
}

/// Multipliers, derivatives and the tangent of a point that is found.
bool BranchFollower::finish(const VectorXd &ahead, Point &point)
{
  const Index m = point.z.size();
  equations_.evaluate(point.z, point.lambda, true);
  point.solution   = equations_.solution();
  point.derivative = derivative(point.z, point.lambda);
  point.regular    = least_pivot(point.derivative.leftCols(m));
  VectorXd last    = VectorXd::Zero(m + 1);
  last[m]          = 1.;
  point.tangent    = bordered(point.derivative, ahead).partialPivLu().solve(last).normalized();
  return point.tangent.allFinite();
}

bool BranchFollower::at_parameter(const VectorXd &z, double lambda, const Point &near, Point &point)
{
  VectorXd across  = VectorXd::Zero(z.size() + 1);
  across[z.size()] = 1.;
  if (!correct(z, lambda, across, near, point) || !finish(across, point))
    return false;
  if (point.tangent.dot(near.tangent) < 0.)
    point.tangent *= -1.;
  return true;
}

bool BranchFollower::beyond(const Point &from, double ds, Point &point)
{
  const Index m = from.z.size();
  return correct(from.z + ds * size_ * from.tangent.head(m), from.lambda + ds * range_ * from.tangent[m], from.tangent,
                 from, point) &&
         finish(from.tangent, point);
}

bool BranchFollower::between(const VectorXd &across, const Point &low, const Point &high, double share, Detail detail,
                             Point &point)
{
  const Point &near = share < 0.5 ? low : high;
  if (!correct(low.z + share * (high.z - low.z), low.lambda + share * (high.lambda - low.lambda), across, near, point))
    return false;
  if (detail == Detail::all)
    return finish(across, point);
  point.solution = equations_.solution();
  return true;
}

} // namespace gestell::coupling

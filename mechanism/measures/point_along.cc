#include "mechanism/measures/point_along.h"

#include <cmath>

namespace gestell::mechanism
{

Turn PointAlong::turn(const Placement &placement, const double *u)
{
  if (!placement.turns())
    return {};
  const double phi = u[placement.n_measures() - 1];
  return {std::cos(phi), std::sin(phi)};
}

/// Part of the arm across the axis n: beyond = n x arm at phi = 0, across = -n x beyond.
PointAlong::PointAlong(const Placement &placement, const Vector3d &a)
    : n_linear_(placement.n_measures() - (placement.turns() ? 1 : 0)), turns_(placement.turns())
{
  const double           at_zero[Placement::max_measures] = {};
  Placement::MovedVector x;
  placement.position(at_zero, nullptr, x);
  Vector3d across = Vector3d::Zero(), beyond = across;
  if (turns_)
  {
    beyond = x.J.col(n_linear_);
    across = -placement.rotation(n_linear_).cross(beyond);
  }
  point_ = {a.dot(placement.point() - across), a.dot(across), a.dot(beyond)};
  for (int i = 0; i < n_linear_; ++i)
  {
    const Vector3d tilt = turns_ ? placement.rotation(i) : Vector3d::Zero();
    linear_[i] = {a.dot(x.J.col(i) - tilt.cross(across)), a.dot(tilt.cross(across)), a.dot(tilt.cross(beyond))};
    tilts_     = tilts_ || linear_[i].cosine != 0. || linear_[i].sine != 0.;
  }
}

bool PointAlong::depends(int i) const
{
  const Term &term = i < n_linear_ ? linear_[std::size_t(i)] : point_; // the derivative along phi needs no b_0
  return term.cosine != 0. || term.sine != 0. || (i < n_linear_ ? term.fixed != 0. : tilts_);
}

Turn PointAlong::turned(const double *u) const
{
  Turn sum{point_.cosine, point_.sine};
  for (int i = 0; tilts_ && i < n_linear_; ++i)
  {
    sum.cosine += u[i] * linear_[i].cosine;
    sum.sine += u[i] * linear_[i].sine;
  }
  return sum;
}

double PointAlong::value(const double *u, const Turn &turn, double *gradient, int stride) const
{
  double s = point_.fixed;
  for (int i = 0; i < n_linear_; ++i)
  {
    s += u[i] * linear_[i].fixed;
    gradient[i * stride] = linear_[i].fixed;
  }
  if (!turns_)
    return s;
  for (int i = 0; tilts_ && i < n_linear_; ++i)
    gradient[i * stride] += linear_[i].cosine * turn.cosine + linear_[i].sine * turn.sine;
  const Turn sum               = turned(u);
  gradient[n_linear_ * stride] = sum.sine * turn.cosine - sum.cosine * turn.sine;
  return s + (sum.cosine * turn.cosine + sum.sine * turn.sine);
}

double PointAlong::bias(const double *u, const double *v, const Turn &turn) const
{
  if (!turns_)
    return 0.;
  const Turn   sum  = turned(u);
  const double w    = v[n_linear_];
  double       rate = 0.; // of the slope along phi, by the tilts
  for (int i = 0; tilts_ && i < n_linear_; ++i)
    rate += v[i] * (linear_[i].sine * turn.cosine - linear_[i].cosine * turn.sine);
  return 2. * w * rate - w * w * (sum.cosine * turn.cosine + sum.sine * turn.sine);
}

} // namespace gestell::mechanism

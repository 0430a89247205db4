#include "coupling/integration/bdf/bdf.h"
#include "coupling/integration/system/hermite.h"

#include <algorithm>

namespace gestell::coupling
{

int Bdf::interpolation_points(double *t, const Point **points) const
{
  const int n = std::min(n_past_, 3);
  for (int i = 0; i < n; ++i)
  {
    points[i] = &past(i);
    t[i]      = past(i).t;
  }
  return n;
}

/// Weights of the newest points, one more than the order, for the interpolated value at t.
int Bdf::value_weights(double t, double *weights) const
{
  const int n = std::min(n_past_, options_.order + 1);
  for (int i = 0; i < n; ++i)
  {
    weights[i] = 1.;
    for (int j = 0; j < n; ++j)
      if (j != i)
        weights[i] *= (t - past(j).t) / (past(i).t - past(j).t);
  }
  return n;
}

void Bdf::interpolate(double t, LocalState &state) const
{
  double       times[3] = {};
  const Point *points[3];
  const int    n       = interpolation_points(times, points);
  const auto   weights = hermite_weights(times, n, t);
  state.t              = t;
  state.u.setZero();
  state.v.setZero();
  for (int i = 0; i < n; ++i)
  {
    state.u += weights.value[i] * points[i]->u + weights.slope[i] * points[i]->u_rate;
    state.v += weights.rate_value[i] * points[i]->u + weights.rate_slope[i] * points[i]->u_rate;
  }
  double    L[capacity];
  const int n_L = value_weights(t, L);
  state.a.setZero();
  state.p.setZero();
  state.lambda.setZero();
  for (int i = 0; i < n_L; ++i)
  {
    state.a += L[i] * past(i).a;
    state.p += L[i] * past(i).p;
    state.lambda += L[i] * past(i).lambda;
  }
  if (!finds_held())
    return;
  // Interpolates values only: q'' of modes that the step does not resolve would be that of the cubic.
  q_inside_.setZero();
  v_inside_.setZero();
  for (int i = 0; i < n_L; ++i)
  {
    q_inside_ += L[i] * past(i).q;
    v_inside_ += L[i] * past(i).v;
  }
  consistent_->hold(q_inside_, v_inside_, state, work_);
}

void Bdf::interpolate(double t, Eigen::VectorXd &q, Eigen::VectorXd &v) const
{
  double       times[3] = {};
  const Point *points[3];
  const int    n       = interpolation_points(times, points);
  const auto   weights = hermite_weights(times, n, t);
  q.setZero();
  v.setZero();
  for (int i = 0; i < n; ++i)
  {
    q += weights.value[i] * points[i]->q + weights.slope[i] * points[i]->v;
    v += weights.rate_value[i] * points[i]->q + weights.rate_slope[i] * points[i]->v;
  }
}

} // namespace gestell::coupling

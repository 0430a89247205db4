#include "mechanism/elements/follower_load.h"

#include "mechanism/measures/relative_measure.h"
#include "mechanism/require.h"

#include <utility>

namespace gestell::mechanism
{

FollowerLoad::FollowerLoad(const Placement &point, const Vector3d &e, std::shared_ptr<const ForceLaw> law)
    : point_(point), e_(e), law_(std::move(law))
{
  require(law_->n_measures() == 1, "follower load", "number of measures of its law", law_->n_measures(), "1");
  require(point_.n_measures() > 0, "follower load", "number of motions of its point", 0.,
          "1 or more, because it is on a body");
}

FollowerLoad::Kinematics FollowerLoad::kinematics_of(const LocalMotion &motion) const
{
  Kinematics             kinematics;
  Placement::MovedVector x, e;
  point_.position(motion.u, motion.v, x);
  point_.direction(e_, motion.u, motion.v, e);
  for (int i = 0; i < n_measures(); ++i)
    kinematics.G[i] = e.value.dot(x.J.col(i));
  kinematics.rate = e.value.dot(x.rate);
  return kinematics;
}

void FollowerLoad::start(const LocalMotion &motion, double *history) const
{
  const Kinematics kinematics = kinematics_of(motion);
  branches_->start(kinematics.motion(motion), history);
}

void FollowerLoad::force(const LocalMotion &motion, const double *history, double *p) const
{
  const Kinematics kinematics = kinematics_of(motion);
  double           P;
  law_->force(kinematics.motion(motion), history, &P);
  for (int i = 0; i < n_measures(); ++i)
    p[i] = P * kinematics.G[i];
}

void FollowerLoad::tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
                           double *dp) const
{
  const Kinematics kinematics = kinematics_of(motion);
  const int        k          = n_measures();
  double           P, dP;
  law_->tangent(kinematics.motion(motion), history, {0., w.v, 0.}, &P, &dP); // the law sees no displacement
  for (int j = 0; j < k; ++j)
  {
    p[j] = P * kinematics.G[j];
    for (int i = 0; i < k; ++i)
      dp[i + k * j] = kinematics.G[i] * dP * kinematics.G[j];
  }
}

namespace
{

/// Adds e . d^2x/du_i du_j for a constant direction e to the matrix.
void add_bending(const Placement &point, const Vector3d &e, const double *u, double *matrix)
{
  const auto bias = [&](const double *v)
  {
    Placement::MovedVector x;
    point.position(u, v, x);
    return e.dot(x.bias);
  };
  add_polarised<Placement::max_measures>(point.n_measures(), bias, 1., matrix);
}

} // namespace

void FollowerLoad::geometric(const LocalMotion &motion, const double *history, double *K) const
{
  const Kinematics kinematics = kinematics_of(motion);
  const int        k          = n_measures();
  double           P, dP, turn[Placement::max_measures * Placement::max_measures] = {}; // dG_i/du_j
  law_->tangent(kinematics.motion(motion), history, {0., 1., 0.}, &P, &dP);
  Placement::MovedVector x, e;
  point_.position(motion.u, nullptr, x);
  point_.direction(e_, motion.u, nullptr, e);
  add_bending(point_, e.value, motion.u, turn);
  for (int j = 0; j < k; ++j)
  {
    double of_rate = 0.; // e . x' = G u'
    for (int i = 0; i < k; ++i)
    {
      turn[i + k * j] += e.J.col(j).dot(x.J.col(i));
      of_rate += turn[i + k * j] * motion.v[i];
    }
    for (int i = 0; i < k; ++i)
      K[i + k * j] -= P * turn[i + k * j] + dP * kinematics.G[i] * of_rate;
  }
}

void FollowerLoad::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const Kinematics kinematics = kinematics_of(motion);
  branches_->guard_values(kinematics.motion(motion), history, g);
}

void FollowerLoad::transition(int i, const LocalMotion &motion, double *history) const
{
  const Kinematics kinematics = kinematics_of(motion);
  branches_->transition(i, kinematics.motion(motion), history);
}

bool FollowerLoad::command(const SwitchCommand &order, const LocalMotion &motion, double *history) const
{
  const Kinematics kinematics = kinematics_of(motion);
  return commands_->command(order, kinematics.motion(motion), history);
}

double FollowerLoad::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const Kinematics kinematics = kinematics_of(motion);
  return law_->quantity(i, kinematics.motion(motion), history);
}

} // namespace gestell::mechanism

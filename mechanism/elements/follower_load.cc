#include "mechanism/elements/follower_load.h"

#include "mechanism/require.h"

#include <utility>

namespace gestell::mechanism
{

FollowerLoad::FollowerLoad(const Placement &point, const Vector3d &e, std::shared_ptr<const ForceLaw> law)
    : point_(point), e_(e), law_(std::move(law))
{
  require(law_->n_measures() == 1, "follower load", "number of measures of its law", law_->n_measures(), "1");
  require(point_.n_measures() > 0, "follower load", "number of motions of its point", 0.,
          "1 or more: it lies on a body");
}

FollowerLoad::Seen FollowerLoad::see(const LocalMotion &motion) const
{
  Seen                   seen;
  Placement::MovedVector x, e;
  point_.position(motion.u, motion.v, x);
  point_.direction(e_, motion.u, motion.v, e);
  for (int i = 0; i < n_measures(); ++i)
    seen.G[i] = e.value.dot(x.J.col(i));
  seen.rate = e.value.dot(x.rate);
  return seen;
}

void FollowerLoad::start(const LocalMotion &motion, double *history) const
{
  const Seen seen = see(motion);
  branches_->start(seen.motion(motion), history);
}

void FollowerLoad::force(const LocalMotion &motion, const double *history, double *p) const
{
  const Seen seen = see(motion);
  double     P;
  law_->force(seen.motion(motion), history, &P);
  for (int i = 0; i < n_measures(); ++i)
    p[i] = P * seen.G[i];
}

void FollowerLoad::tangent(const LocalMotion &motion, const double *history, const TangentWeights &w, double *p,
                           double *dp) const
{
  const Seen seen = see(motion);
  const int  k    = n_measures();
  double     P, dP;
  law_->tangent(seen.motion(motion), history, w, &P, &dP);
  for (int j = 0; j < k; ++j)
  {
    p[j] = P * seen.G[j];
    for (int i = 0; i < k; ++i)
      dp[i + k * j] = seen.G[i] * dP * seen.G[j];
  }
}

void FollowerLoad::guard_values(const LocalMotion &motion, const double *history, double *g) const
{
  const Seen seen = see(motion);
  branches_->guard_values(seen.motion(motion), history, g);
}

void FollowerLoad::transition(int i, const LocalMotion &motion, double *history) const
{
  const Seen seen = see(motion);
  branches_->transition(i, seen.motion(motion), history);
}

bool FollowerLoad::command(const SwitchCommand &order, const LocalMotion &motion, double *history) const
{
  const Seen seen = see(motion);
  return commands_->command(order, seen.motion(motion), history);
}

double FollowerLoad::quantity(int i, const LocalMotion &motion, const double *history) const
{
  const Seen seen = see(motion);
  return law_->quantity(i, seen.motion(motion), history);
}

} // namespace gestell::mechanism

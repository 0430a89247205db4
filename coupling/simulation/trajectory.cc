#include "coupling/simulation/trajectory.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

void Trajectory::begin(const Instant &at, const Eigen::VectorXd &history)
{
  history_ = history;
  pieces_.assign(1, {{{at.t, at.q, at.v}}, {}});
}

void Trajectory::add(const TimeIntegrator &integrator, double t)
{
  MotionNode node;
  node.t = t;
  node.q.resize(pieces_.front().nodes.front().q.size());
  node.v.resize(node.q.size());
  integrator.interpolate(t, node.q, node.v);
  pieces_.back().nodes.push_back(std::move(node));
}

void Trajectory::step(const TimeIntegrator &integrator, double spacing)
{
  const double begin = integrator.step_begin(), end = integrator.time();
  if (!(end > begin))
    return;
  if (!pieces_.back().guards.empty())
  {
    pieces_.emplace_back();
    add(integrator, begin);
  }
  constexpr int most_inside = 1000; // nodes of a step: one that lasts a run would fill the memory
  const int     parts       = int(std::clamp(std::ceil((end - begin) / spacing), 1., double(most_inside)));
  for (int k = 1; k < parts; ++k)
    add(integrator, begin + (end - begin) * k / parts);
  const Instant &now = integrator.instant();
  pieces_.back().nodes.push_back({end, now.q, now.v});
}

void Trajectory::guard(int number)
{
  pieces_.back().guards.push_back(number);
}

} // namespace gestell::coupling

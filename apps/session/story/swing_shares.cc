#include "apps/session/story/swing_shares.h"

#include "apps/session/main_peak.h"
#include "coupling/machine/configuration/dense_matrices.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

/// F at q with the mean velocities of two states, from the motion alone.
class ForceBetween
{
public:
  ForceBetween(const coupling::Signal &signal, const coupling::Machine &machine)
      : signal_(signal), machine_(machine), zero_(Eigen::VectorXd::Zero(machine.size()))
  {
    local_.resize(machine);
  }

  void between(const coupling::KeptState &a, const coupling::KeptState &b)
  {
    t_ = 0.5 * (a.t + b.t);
    v_ = 0.5 * (a.v + b.v);
  }

  double operator()(const Eigen::VectorXd &q)
  {
    machine_.gather(t_, q, v_, zero_, local_);
    return machine_.evaluate(signal_, q, v_, local_);
  }

private:
  const coupling::Signal  &signal_;
  const coupling::Machine &machine_;
  double                   t_ = 0.;
  Eigen::VectorXd          v_, zero_;
  coupling::LocalState     local_;
};

} // namespace

std::vector<coupling::SignalExtreme> swing_extremes(const std::vector<coupling::Signal> &signals, int n)
{
  std::vector<coupling::SignalExtreme> extremes;
  const int                            main = main_signal(signals);
  const auto                           add  = [&](int signal)
  {
    for (const bool largest : {true, false})
      extremes.push_back({signal, largest});
  };
  if (main >= 0)
    add(main);
  for (int s = 0; s < int(signals.size()); ++s)
    if (s != main && (signals[std::size_t(s)].unit == "N" || signals[std::size_t(s)].unit == "N m"))
      add(s);
  constexpr double most_memory = 64e6, kept_states = 600.; // byte
  const double     of_one = kept_states * 3. * sizeof(double) * std::max(1, n);
  extremes.resize(std::min(extremes.size(), std::size_t(most_memory / of_one)));
  return extremes;
}

const coupling::KeptState *state_near(const std::vector<coupling::KeptState> &states, double t, double reach)
{
  const coupling::KeptState *nearest = nullptr;
  for (const coupling::KeptState &state : states)
    if (std::abs(state.t - t) <= (nearest ? std::abs(nearest->t - t) : reach))
      nearest = &state;
  return nearest;
}

std::vector<const coupling::KeptState *> states_of_swing(const std::vector<coupling::KeptState> &states, double from,
                                                         double to, double reach)
{
  const auto *first = state_near(states, std::min(from, to), reach),
             *last  = state_near(states, std::max(from, to), reach);
  if (!first || !last || last <= first)
    return {};
  constexpr long                           most_parts = 32; // of a swing
  const auto                               n = last - first, stride = (n + most_parts - 1) / most_parts;
  std::vector<const coupling::KeptState *> path;
  for (const auto *state = first; state < last; state += stride)
    path.push_back(state);
  path.push_back(last);
  if (from > to)
    std::reverse(path.begin(), path.end());
  return path;
}

Eigen::VectorXd swing_changes(const coupling::Signal &signal, const coupling::Machine &machine,
                              const std::vector<coupling::Mode>              &modes,
                              const std::vector<const coupling::KeptState *> &path)
{
  const Eigen::MatrixXd M    = coupling::dense_mass(machine);
  Eigen::VectorXd       c    = Eigen::VectorXd::Zero(Eigen::Index(modes.size()));
  coupling::Signal      held = signal; // a force of the frame by its deformation, without the inertia beyond its modes
  held.on_a.clear();
  if (held.reads_acceleration())
    return c;
  ForceBetween force(held, machine);
  for (std::size_t k = 0; k + 1 < path.size(); ++k)
  {
    const Eigen::VectorXd moved = M * (path[k + 1]->q - path[k]->q), middle = 0.5 * (path[k]->q + path[k + 1]->q);
    force.between(*path[k], *path[k + 1]);
    for (std::size_t j = 0; j < modes.size(); ++j)
    {
      const Eigen::VectorXd half = 0.5 * modes[j].shape.dot(moved) * modes[j].shape;
      c[Eigen::Index(j)] += force(middle + half) - force(middle - half);
    }
  }
  return c;
}

} // namespace gestell::apps

#include "apps/session/story/swing_shares.h"

#include "apps/session/stages/main_peak.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

constexpr double most_memory = 64e6, kept_states = 600.; ///< bytes; states around an extreme
constexpr double little  = 1e-7;                         ///< largest motion of a quotient [m or rad]
constexpr double at_rest = 1e-6;                         ///< [Hz]

/// F at q, by the motion alone.
class ForceAt
{
public:
  ForceAt(const coupling::Signal &signal, const coupling::Machine &machine, const coupling::KeptState &state)
      : signal_(signal), machine_(machine), state_(state), zero_(Eigen::VectorXd::Zero(state.q.size()))
  {
    local_.resize(machine);
  }

  double operator()(const Eigen::VectorXd &q)
  {
    machine_.gather(state_.t, q, state_.v, zero_, local_);
    return machine_.evaluate(signal_, q, state_.v, local_);
  }

private:
  const coupling::Signal    &signal_;
  const coupling::Machine   &machine_;
  const coupling::KeptState &state_;
  Eigen::VectorXd            zero_;
  coupling::LocalState       local_;
};

/// dF/dq . v, towards less of the motion, on the branch that holds there.
double derivative(ForceAt &force, const Eigen::VectorXd &q, const Eigen::VectorXd &v, double sign)
{
  const double step = sign * little / v.cwiseAbs().maxCoeff();
  return (force(q) - force(q - step * v)) / step;
}

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
  const double of_one = kept_states * 3. * sizeof(double) * std::max(1, n);
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

Eigen::VectorXd swing_shares(const coupling::Signal &signal, const coupling::Machine &machine, const Result &result,
                             const coupling::KeptState &q_0, const coupling::KeptState &q_1, bool &of_force)
{
  const auto           &modes = result.coupled_modes;
  const Eigen::VectorXd moved = coupling::dense_mass(machine) * (q_1.q - q_0.q);
  Eigen::VectorXd       c = Eigen::VectorXd::Zero(Eigen::Index(modes.size())), energy = c;
  ForceAt               force(signal, machine, q_1);
  for (std::size_t j = 0; j < modes.size(); ++j)
  {
    if (modes[j].frequency_hz < at_rest)
      continue;
    const double eta        = modes[j].shape.dot(moved);
    c[Eigen::Index(j)]      = std::abs(eta * derivative(force, q_1.q, modes[j].shape, eta < 0. ? -1. : 1.));
    energy[Eigen::Index(j)] = std::pow(two_pi * modes[j].frequency_hz * eta, 2);
  }
  of_force = c.sum() > 0.;
  if (!of_force)
    c = energy;
  return c.sum() > 0. ? Eigen::VectorXd(c / c.sum()) : c;
}

} // namespace gestell::apps

#include "coupling/simulation/checks/told_by_time.h"

namespace gestell::coupling
{

namespace
{

using Eigen::VectorXd;

/// Values as functions of time only.
struct Changes
{
  VectorXd changes, differs; ///< largest, from the first instant and from that a shift later

  template <typename Values>
  Changes(const Values &values, double begin, double span, double shift)
  {
    const VectorXd first = values(begin);
    changes = differs    = VectorXd::Zero(first.size());
    constexpr int probes = 7; // instants, off each other's fractions of the span
    for (int k = 1; k <= probes; ++k)
    {
      const double   t   = begin + span * (k - 0.37) / probes;
      const VectorXd now = values(t);
      changes            = changes.cwiseMax((now - first).cwiseAbs());
      differs            = shift > 0. ? differs.cwiseMax((values(t + shift) - now).cwiseAbs()) : changes;
    }
    if (shift > 0.)
      changes = changes.cwiseMax(differs);
  }

  bool depend(Eigen::Index from, Eigen::Index n) const
  {
    const double     change     = n > 0 ? changes.segment(from, n).maxCoeff() : 0.;
    constexpr double same_value = 1e-9; // after a shift, against the largest change: rounding
    return change > 0. && differs.segment(from, n).maxCoeff() > same_value * change;
  }
};

LocalState local_of(const Machine &machine, const InitialState &state)
{
  LocalState local;
  local.resize(machine);
  local.u = machine.forces().directions().transpose() * state.q;
  local.v = machine.forces().directions().transpose() * state.v;
  return local;
}

} // namespace

std::vector<std::string> forces_of_time(const Machine &machine, const InitialState &state, double span, double shift)
{
  LocalState    local  = local_of(machine, state);
  const auto    blocks = machine.forces().blocks();
  const Changes found(
      [&](double t)
      {
        local.t    = t;
        VectorXd p = VectorXd::Zero(local.u.size());
        machine.forces().force(local, p);
        return p;
      },
      state.t, span, shift);
  std::vector<std::string> names;
  std::size_t              b = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    if (placement.element->ideal_joint() || b >= blocks.size())
      continue;
    if (found.depend(blocks[b].first_measure, blocks[b].n_measures))
      names.push_back(placement.name);
    ++b;
  }
  return names;
}

std::vector<std::string> motions_of_time(const Machine &machine, const InitialState &state, double span, double shift)
{
  LocalState    local = local_of(machine, state);
  const Changes found(
      [&](double t)
      {
        local.t = t;
        VectorXd rate(machine.joints().n_rows()), bias(machine.joints().n_rows());
        machine.joints().rates(local, rate, bias);
        return rate;
      },
      state.t, span, shift);
  std::vector<std::string> names;
  const auto              &blocks = machine.joints().blocks();
  std::size_t              b      = 0;
  for (const ElementPlacement &placement : machine.model().elements())
  {
    if (!placement.element->ideal_joint() || b >= blocks.size())
      continue;
    if (found.depend(blocks[b].first_row, blocks[b].n_rows))
      names.push_back(placement.name);
    ++b;
  }
  return names;
}

} // namespace gestell::coupling

#include "coupling/machine/machine_system.h"

#include "coupling/integration/step/law_values.h"
#include "coupling/machine/dense_base.h"
#include "coupling/machine/sparse_base.h"

#include <sstream>

namespace gestell::coupling
{

int MachineLinear::size() const
{
  return parts_.size();
}
void MachineLinear::mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const
{
  parts_.base->mass_times(x, y);
}
void MachineLinear::damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const
{
  parts_.base->damping_times(x, y);
}
void MachineLinear::stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const
{
  parts_.base->stiffness_times(x, y);
}

namespace
{
/// w M with w on the diagonal of virtual coordinates, which nothing couples to others: the solver of all that has mass.
std::unique_ptr<LinearSolver> factorise_mass(const LinearBase &base, const std::vector<int> &massless, double w)
{
  if (const auto *dense = dynamic_cast<const DenseBase *>(&base.plain()))
  {
    Eigen::MatrixXd       M    = dense->mass();
    const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(M.rows(), M.cols());
    for (const int i : massless)
      M(i, i) = 1.;
    return DenseBase(M, zero, zero, {}).factorise(w, 0., 0.);
  }
  if (const auto *sparse = dynamic_cast<const SparseBase *>(&base))
  {
    Eigen::SparseMatrix<double>       M = sparse->mass();
    const Eigen::SparseMatrix<double> zero(M.rows(), M.cols());
    for (const int i : massless)
      M.coeffRef(i, i) = 1.;
    return SparseBase(M, zero, zero).factorise(w, 0., 0.);
  }
  return base.factorise(w, 0., 0.);
}
} // namespace

std::unique_ptr<LinearSolver> MachineLinear::factorise(double w_M, double w_B, double w_C) const
{
  if (w_B == 0. && w_C == 0. && !parts_.lag_coordinates.empty())
    return factorise_mass(*parts_.base, parts_.lag_coordinates, w_M);
  return parts_.base->factorise(w_M, w_B, w_C);
}

std::vector<SpectrumLine> MachineLinear::spectrum() const
{
  return parts_.base->spectrum();
}
const Excitation &MachineLinear::excitation() const
{
  return parts_.excitation;
}
bool MachineLinear::dense_matrices(Eigen::MatrixXd &M, Eigen::MatrixXd &B, Eigen::MatrixXd &C) const
{
  // coordinates whose dense matrices are cheaper than their sparse factors, or nearly
  constexpr int largest_mechanism = 600;
  if (const auto *dense = dynamic_cast<const DenseBase *>(&parts_.base->plain()))
  {
    M = dense->mass();
    B = dense->damping();
    C = dense->stiffness();
    return true;
  }
  const auto *sparse = dynamic_cast<const SparseBase *>(parts_.base.get());
  if (!sparse || parts_.full || size() > largest_mechanism)
    return false;
  M = sparse->mass();
  B = sparse->damping();
  C = sparse->stiffness();
  return true;
}
/// Not for an unreduced frame, whose factor is computed once per step size and stored.
bool MachineLinear::sparse_matrices(Eigen::SparseMatrix<double> &M, Eigen::SparseMatrix<double> &B,
                                    Eigen::SparseMatrix<double> &C) const
{
  if (const auto *dense = dynamic_cast<const DenseBase *>(&parts_.base->plain()))
  {
    M = dense->mass().sparseView();
    B = dense->damping().sparseView();
    C = dense->stiffness().sparseView();
    return true;
  }
  const auto *sparse = dynamic_cast<const SparseBase *>(parts_.base.get());
  if (!sparse || parts_.full)
    return false;
  M = sparse->mass();
  B = sparse->damping();
  C = sparse->stiffness();
  return true;
}

const std::vector<int> &MachineLinear::virtual_coordinates() const
{
  return parts_.lag_coordinates;
}

std::string MachineLinear::coordinate_name(int i) const
{
  return parts_.coordinate_name(i);
}

void MachineEvents::follow_history(bool follow)
{
  parts_.by_history = follow;
}

Eigen::VectorXd MachineEvents::save_history() const
{
  return parts_.history;
}

void MachineEvents::restore_history(const Eigen::VectorXd &saved)
{
  parts_.history = saved;
  parts_.refresh_guards();
}

void MachineEvents::start(const LocalState &state)
{
  for (const auto &part : parts_.placed)
    if (part.branches)
      part.branches->start(part.motion(state, parts_.by_history), parts_.history_of(part));
  parts_.start_switches(&state);
  for (auto &part : parts_.placed)
    if (part.stop >= 0)
    {
      part.holds                    = false;
      parts_.history[part.stop]     = 0.;
      parts_.history[part.stop + 1] = -1.;
    }
  parts_.find_stopped(state);
  parts_.refresh_guards();
}

void MachineEvents::accept(const LocalState &state)
{
  for (const auto &part : parts_.placed)
    if (part.branches)
      part.branches->accept(part.motion(state, parts_.by_history), parts_.history_of(part));
  parts_.find_sides(state);
}

int MachineEvents::n_guards() const
{
  return static_cast<int>(parts_.guards.size());
}

void MachineEvents::guard_values(const LocalState &motion, Eigen::VectorXd &g) const
{
  if (!parts_.held_too.empty())
    parts_.watched_state = motion;
  for (const HeldMeasure &h : parts_.held_too)
    parts_.watched_state.v[h.measure] = h.rate;
  const LocalState &state = parts_.held_too.empty() ? motion : parts_.watched_state;
  int               first = 0;
  for (const auto &part : parts_.placed)
  {
    if (!part.branches || parts_.is_stopped(part))
      continue;
    const double *history = parts_.history_of(part);
    const int     n       = part.branches->n_guards(history);
    if (n > 0)
      part.branches->guard_values(part.motion(state, parts_.by_history), history, g.data() + first);
    first += n;
  }
  for (const auto &own : parts_.switches)
    if (parts_.is_active(own))
      g[first++] = parts_.switch_guard(own, state);
}

GuardCrossing MachineEvents::crossing(int i) const
{
  return parts_.guards[i].crossing;
}
ActiveGuard MachineEvents::guard(int i) const
{
  return parts_.guards[i].guard;
}

void MachineEvents::transition(int i, const LocalState &state)
{
  const auto &active = parts_.guards[i];
  if (active.element < 0)
  {
    parts_.throw_switch(active.index, state);
    parts_.find_stopped(state);
    parts_.refresh_guards();
    return;
  }
  auto     &part      = parts_.placed[active.element];
  const int came_from = active.crossing == GuardCrossing::falling ? 1 : -1;
  if (active.guard.kind == "stick")
    part.came = came_from;
  if (part.stop >= 0 && !part.holds)
    parts_.history[part.stop + 1] = came_from;
  try
  {
    part.branches->transition(active.index, part.motion(state, parts_.by_history), parts_.history_of(part));
  }
  catch (const std::domain_error &beyond) // the element has no law that can be continued
  {
    std::ostringstream message;
    message << "at t = " << state.t << " s, \"" << parts_.elements[active.element].name << "\": " << beyond.what();
    throw ConvergenceFailure(message.str());
  }
  parts_.find_stopped(state);
  part.came = 0;
  parts_.refresh_guards();
}

namespace
{
[[noreturn]] void throw_without_energy(const std::string &element, const LocalState &state, int measure)
{
  std::ostringstream message;
  message << "\"" << element << "\" has no finite energy at t = " << state.t << ", u = " << state.u[measure]
          << ", u' = " << state.v[measure]
          << " (SI units), the end of the range of its law, as for the piston of a gas at "
          << "the end of its cylinder; check its position and the loads on it, or end the run before";
  throw ConvergenceFailure(message.str());
}
} // namespace

double MachineEnergy::stored(const LocalState &state) const
{
  double energy = 0.;
  for (const auto &part : parts_.placed)
    if (part.law)
    {
      const double own = part.law->stored_energy(part.motion(state, parts_.by_history), parts_.history_of(part));
      if (!std::isfinite(own) && std::abs(state.u[part.first_measure]) < beyond_machines)
        throw_without_energy(part.name, state, part.first_measure);
      energy += own;
    }
  return energy;
}

void MachineEnergy::power(const LocalState &state, const Eigen::VectorXd &p, double &input, double &dissipated) const
{
  input = dissipated = 0.;
  for (const auto &part : parts_.placed)
  {
    if (part.first_constraint >= 0)
      input += part.drives ? parts_.prescribed_power(part, state) : 0.;
    else if (part.holds)
      (part.drives ? input : dissipated) +=
          (part.drives ? 1. : -1.) * p[part.first_measure] * parts_.held_rate(part.first_measure);
    else if (part.drives)
      input += p.segment(part.first_measure, part.n_motions).dot(state.v.segment(part.first_measure, part.n_motions));
    else
      dissipated += parts_.taken_power(part, state);
  }
}

} // namespace gestell::coupling

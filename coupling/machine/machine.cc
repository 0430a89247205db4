#include "coupling/machine/machine.h"

#include "coupling/machine/dense_base.h"
#include "coupling/machine/machine_parts.h"
#include "coupling/machine/sparse_base.h"
#include "fem/values/nearest_name.h"

#include <cassert>
#include <cmath>
#include <numeric>
#include <sstream>

namespace gestell::coupling
{

Machine::Machine() : parts_(std::make_unique<Parts>())
{
  Marker ground;
  ground.name               = "ground";
  parts_->markers["ground"] = ground;
}

Machine::~Machine()                              = default;
Machine::Machine(Machine &&) noexcept            = default;
Machine &Machine::operator=(Machine &&) noexcept = default;

void Machine::set_frame(ReducedFrame frame)
{
  parts_->n_frame     = static_cast<int>(frame.M.rows());
  parts_->n_interface = frame.n_interface;
  parts_->add_interfaces(frame.interfaces);
  parts_->reduced = std::make_unique<ReducedFrame>(std::move(frame));
}

void Machine::set_frame(fem::FrameMatrices frame)
{
  parts_->n_frame     = static_cast<int>(frame.M.rows());
  parts_->n_interface = static_cast<int>(frame.interface_coordinates().size());
  parts_->add_interfaces(frame.interfaces);
  parts_->full = std::make_unique<fem::FrameMatrices>(std::move(frame));
}

void Machine::set_gravity(const Vector3 &g)
{
  parts_->gravity = g;
}

void Machine::add_linear(const std::string &name, const Measure &u, double stiffness, double damping, double preload,
                         double rest, const std::string &force_unit)
{
  parts_->add_dyad(parts_->C, stiffness, u);
  parts_->add_dyad(parts_->B, damping, u);
  for (const auto &[coordinate, weight] : u)
    parts_->constant_load.emplace_back(coordinate, weight * (stiffness * rest - preload));
  parts_->linear.push_back({name, u, stiffness, damping, preload - stiffness * rest, force_unit});
}

void Machine::add_load(const std::string &name, const Measure &u, double constant,
                       const std::vector<Oscillation> &oscillations, const std::string &force_unit)
{
  for (const Oscillation &part : oscillations)
    if (!(part.omega > 0.))
      throw std::invalid_argument("load \"" + name + "\": circular frequency " + std::to_string(part.omega) +
                                  " rad/s must be positive; a constant load is given as such");
  for (const auto &[coordinate, weight] : u)
    parts_->constant_load.emplace_back(coordinate, weight * constant);
  parts_->loads.push_back({name, force_unit, u, constant, oscillations});
}

void Machine::attach(const std::string &name, std::shared_ptr<mechanism::ForceElement> element,
                     const std::vector<Measure> &measures, MeasureKind kind)
{
  if (static_cast<int>(measures.size()) != element->n_measures())
    throw std::invalid_argument("element \"" + name + "\" takes " + std::to_string(element->n_measures()) +
                                " measures, but " + std::to_string(measures.size()) + " were given");
  parts_->elements.push_back({name, std::move(element), measures, -1, kind});
}

void Machine::attach_friction(std::shared_ptr<mechanism::ForceElement> element, const std::vector<Measure> &measures)
{
  const int joint = static_cast<int>(parts_->elements.size()) - 1;
  assert(joint >= 0 && parts_->elements[joint].element->n_constraints() > 0);
  attach(std::string(parts_->elements[joint].name), std::move(element), measures);
  parts_->elements.back().joint = joint;
}

void Machine::finish()
{
  parts_->finish();
}

const Marker &Machine::marker(const std::string &name) const
{
  const auto found = parts_->markers.find(name);
  if (found != parts_->markers.end())
    return found->second;
  std::vector<std::string> names;
  for (const auto &entry : parts_->markers)
    names.push_back(entry.first);
  throw std::invalid_argument("there is no body or interface \"" + name + "\"" + suggestion(name, names));
}

const Body &Machine::body(const std::string &name) const
{
  std::vector<std::string> names;
  for (const Body &body : parts_->bodies)
  {
    if (body.name == name)
      return body;
    names.push_back(body.name);
  }
  throw std::invalid_argument("there is no body \"" + name + "\"" +
                              (names.empty() ? std::string("; the scene has none") : suggestion(name, names)));
}

const std::vector<Body> &Machine::bodies() const
{
  return parts_->bodies;
}
const std::vector<DrawnRod> &Machine::rods() const
{
  return parts_->rods;
}
const std::vector<DrawnBar> &Machine::bars() const
{
  return parts_->bars;
}
const std::vector<DrawnPin> &Machine::pins() const
{
  return parts_->pins;
}
const std::vector<ElementPlacement> &Machine::elements() const
{
  return parts_->elements;
}
const std::vector<Switch> &Machine::switches() const
{
  return parts_->switch_requests;
}
const ReducedFrame *Machine::reduced_frame() const
{
  return parts_->reduced.get();
}
const fem::FrameMatrices *Machine::full_frame() const
{
  return parts_->full.get();
}
const LinearBase &Machine::base() const
{
  return *parts_->base;
}
int Machine::n_frame() const
{
  return parts_->n_frame;
}
int Machine::n_mechanism() const
{
  return static_cast<int>(parts_->coordinate_names.size());
}
int Machine::n_interface() const
{
  return parts_->n_interface;
}
Eigen::MatrixXd Machine::translation_loads() const
{
  return parts_->translation_loads;
}

// --- SecondOrderSystem

int Machine::size() const
{
  return parts_->size();
}
void Machine::mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const
{
  parts_->base->mass_times(x, y);
}
void Machine::damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const
{
  parts_->base->damping_times(x, y);
}
void Machine::stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const
{
  parts_->base->stiffness_times(x, y);
}

namespace
{
/// w M with w on the diagonal of virtual coordinates, which nothing couples to others: the solver of all that has mass.
std::unique_ptr<LinearSolver> factorise_mass(const LinearBase &base, const std::vector<int> &massless, double w)
{
  if (const auto *dense = dynamic_cast<const DenseBase *>(&base))
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

std::unique_ptr<LinearSolver> Machine::factorise(double w_M, double w_B, double w_C) const
{
  if (w_B == 0. && w_C == 0. && !parts_->lag_coordinates.empty())
    return factorise_mass(*parts_->base, parts_->lag_coordinates, w_M);
  return parts_->base->factorise(w_M, w_B, w_C);
}

std::vector<SpectrumLine> Machine::spectrum() const
{
  return parts_->base->spectrum();
}
const Excitation &Machine::excitation() const
{
  return parts_->excitation;
}
bool Machine::dense_matrices(Eigen::MatrixXd &M, Eigen::MatrixXd &B, Eigen::MatrixXd &C) const
{
  constexpr int largest_mechanism = 600;
  if (const auto *dense = dynamic_cast<const DenseBase *>(parts_->base.get()))
  {
    M = dense->mass();
    B = dense->damping();
    C = dense->stiffness();
    return true;
  }
  const auto *sparse = dynamic_cast<const SparseBase *>(parts_->base.get());
  if (!sparse || parts_->full || size() > largest_mechanism)
    return false;
  M = sparse->mass();
  B = sparse->damping();
  C = sparse->stiffness();
  return true;
}
/// Not those of an unreduced frame: its factor is made once per step size and kept.
bool Machine::sparse_matrices(Eigen::SparseMatrix<double> &M, Eigen::SparseMatrix<double> &B,
                              Eigen::SparseMatrix<double> &C) const
{
  if (const auto *dense = dynamic_cast<const DenseBase *>(parts_->base.get()))
  {
    M = dense->mass().sparseView();
    B = dense->damping().sparseView();
    C = dense->stiffness().sparseView();
    return true;
  }
  const auto *sparse = dynamic_cast<const SparseBase *>(parts_->base.get());
  if (!sparse || parts_->full)
    return false;
  M = sparse->mass();
  B = sparse->damping();
  C = sparse->stiffness();
  return true;
}

const Eigen::SparseMatrix<double> &Machine::directions() const
{
  return parts_->W;
}

void Machine::gather(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const Eigen::VectorXd &a,
                     LocalState &local) const
{
  if (local.p.size() != parts_->W.cols())
    local.p.setZero(parts_->W.cols());
  if (local.lambda.size() != n_constraints())
    local.lambda.setZero(n_constraints());
  local.t           = t;
  local.u.noalias() = parts_->W.transpose() * q;
  local.v.noalias() = parts_->W.transpose() * v;
  local.a.noalias() = parts_->W.transpose() * a;
}

std::string Machine::constraint_name(int i) const
{
  for (const int joint : parts_->joints)
  {
    const auto &part = parts_->placed[joint];
    const int   row  = i - part.first_constraint;
    if (row >= 0 && row < part.element->n_constraints())
      return "\"" + parts_->elements[joint].name + "\" (" + part.element->constraint_name(row) + ")";
  }
  return SecondOrderSystem::constraint_name(i);
}

void Machine::follow_history(bool follow)
{
  parts_->by_history = follow;
}

Eigen::VectorXd Machine::save_history() const
{
  return parts_->history;
}

void Machine::restore_history(const Eigen::VectorXd &saved)
{
  parts_->history = saved;
  parts_->refresh_guards();
}

void Machine::start(const LocalState &state)
{
  for (const auto &part : parts_->placed)
    part.element->start(part.motion(state, parts_->by_history), parts_->history_of(part));
  parts_->start_switches(&state);
  for (auto &part : parts_->placed)
    if (part.stop >= 0)
    {
      part.holds                     = false;
      parts_->history[part.stop]     = 0.;
      parts_->history[part.stop + 1] = -1.;
    }
  parts_->find_stopped(state);
  parts_->refresh_guards();
}

/// A contact that is described as just touching may be closed by rounding.
constexpr double touching = 1e-9; // m or rad

std::vector<std::string> Machine::closed_contacts(const LocalState &state) const
{
  std::vector<std::string> closed;
  for (std::size_t e = 0; e < parts_->placed.size(); ++e)
  {
    const auto  &part = parts_->placed[e];
    const double deep = part.element->penetration(part.motion(state, false));
    if (deep <= touching)
      continue;
    std::ostringstream words;
    words << "\"" << parts_->elements[e].name << "\" by " << deep << " (m or rad)";
    closed.push_back(words.str());
  }
  return closed;
}

void Machine::accept(const LocalState &state)
{
  for (const auto &part : parts_->placed)
    part.element->accept(part.motion(state, parts_->by_history), parts_->history_of(part));
  parts_->find_sides(state);
}

int Machine::n_guards() const
{
  return static_cast<int>(parts_->guards.size());
}

void Machine::guard_values(const LocalState &state, Eigen::VectorXd &g) const
{
  int first = 0;
  for (const auto &part : parts_->placed)
  {
    if (parts_->is_stopped(part))
      continue;
    const double *history = parts_->history_of(part);
    const int     n       = part.element->n_guards(history);
    if (n > 0)
      part.element->guard_values(part.motion(state, parts_->by_history), history, g.data() + first);
    first += n;
  }
  for (const auto &own : parts_->switches)
    if (parts_->is_active(own))
      g[first++] = parts_->switch_guard(own, state);
}

GuardCrossing Machine::crossing(int i) const
{
  return parts_->guards[i].crossing;
}
ActiveGuard Machine::guard(int i) const
{
  return parts_->guards[i].guard;
}

void Machine::transition(int i, const LocalState &state)
{
  const auto &active = parts_->guards[i];
  if (active.element < 0)
  {
    parts_->throw_switch(active.index, state);
    parts_->find_stopped(state);
    parts_->refresh_guards();
    return;
  }
  auto     &part      = parts_->placed[active.element];
  const int came_from = active.crossing == GuardCrossing::falling ? 1 : -1;
  if (active.guard.kind == "stick")
    part.came = came_from;
  if (part.stop >= 0 && !part.holds)
    parts_->history[part.stop + 1] = came_from;
  try
  {
    part.element->transition(active.index, part.motion(state, parts_->by_history), parts_->history_of(part));
  }
  catch (const std::domain_error &beyond) // the element has no law that goes on from here
  {
    std::ostringstream message;
    message << "at t = " << state.t << " s, \"" << parts_->elements[active.element].name << "\": " << beyond.what();
    throw ConvergenceFailure(message.str());
  }
  parts_->find_stopped(state);
  part.came = 0;
  parts_->refresh_guards();
}

double Machine::local_stored_energy(const LocalState &state) const
{
  double energy = 0.;
  for (const auto &part : parts_->placed)
    energy += part.element->stored_energy(part.motion(state, parts_->by_history), parts_->history_of(part));
  return energy;
}

void Machine::local_power(const LocalState &state, const Eigen::VectorXd &p, double &input, double &dissipated) const
{
  input = dissipated = 0.;
  for (const auto &part : parts_->placed)
  {
    const bool drives = part.element->work() == mechanism::Work::input;
    if (part.first_constraint >= 0)
      input += drives ? parts_->prescribed_power(part, state) : 0.;
    else if (part.holds)
      (drives ? input : dissipated) +=
          (drives ? 1. : -1.) * p[part.first_measure] * parts_->held_rate(part.first_measure);
    else if (drives)
      input += p.segment(part.first_measure, part.n_motions).dot(state.v.segment(part.first_measure, part.n_motions));
    else
      dissipated += parts_->taken_power(part, state);
  }
}

std::string Machine::coordinate_name(int i) const
{
  return parts_->coordinate_name(i);
}

} // namespace gestell::coupling

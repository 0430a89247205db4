#include "coupling/machine.h"

#include "coupling/dense_base.h"
#include "coupling/machine_parts.h"
#include "coupling/nearest_name.h"
#include "coupling/sparse_base.h"

#include <cmath>
#include <numeric>

namespace gestell::coupling
{

namespace
{
Vector3 unit(const Vector3 &a, const std::string &place)
{
  const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
  if (!(length > 0.))
    throw std::invalid_argument(place + ": the axis has length zero; give a direction such as [0, 0, -1]");
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// The part of a motion across the axis a.
std::array<Measure, 3> across(const std::array<Measure, 3> &motion, const Vector3 &a)
{
  Measure along;
  for (int d = 0; d < 3; ++d)
    along = along + a[d] * motion[d];
  return {motion[0] - a[0] * along, motion[1] - a[1] * along, motion[2] - a[2] * along};
}

void check_mass(double mass, const std::string &what)
{
  if (!(mass >= 0.) || !std::isfinite(mass))
    throw std::invalid_argument(what + " is " + std::to_string(mass) + "; it must be zero or positive");
}
} // namespace

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

int Machine::add_rotor(const std::string &name, const Vector3 &axis, double inertia, double mass,
                       const std::string &carrier)
{
  if (!(inertia > 0.))
    throw std::invalid_argument("rotor \"" + name + "\": inertia " + std::to_string(inertia) +
                                " kg m^2 must be positive");
  check_mass(mass, "rotor \"" + name + "\": mass [kg]");
  const Vector3 a    = unit(axis, "rotor \"" + name + "\"");
  const Marker &base = marker(carrier);
  Marker        own  = base;
  own.name           = name;
  const int phi      = parts_->add_coordinate(name);
  own.rotation       = across(base.rotation, a);
  for (int d = 0; d < 3; ++d)
    own.rotation[d] = own.rotation[d] + a[d] * Measure{{phi, 1.}};
  parts_->add_dyad(parts_->M, inertia, {{phi, 1.}});
  parts_->add_mass(mass, base.translation);
  parts_->add_body({name, BodyKind::rotor, phi, a, parts_->position_of(carrier), 0., {}, own});
  return phi;
}

int Machine::add_slider(const std::string &name, const Vector3 &axis, double mass, const std::string &guide)
{
  check_mass(mass, "slider \"" + name + "\": mass [kg]");
  if (mass == 0.)
    throw std::invalid_argument("slider \"" + name + "\": mass 0 kg; a slider needs a positive mass");
  const Vector3 a    = unit(axis, "slider \"" + name + "\"");
  const Marker &base = marker(guide);
  Marker        own;
  own.name            = name;
  own.rotation        = base.rotation;
  const int  x        = parts_->add_coordinate(name);
  const auto sideways = across(base.translation, a);
  for (int d = 0; d < 3; ++d)
    own.translation[d] = sideways[d] + a[d] * Measure{{x, 1.}};
  // Along a and across it do not couple: added apart, so that no rounding does it either.
  parts_->add_dyad(parts_->M, mass, {{x, 1.}});
  for (int d = 0; d < 3; ++d)
    parts_->add_dyad(parts_->M, mass, sideways[d]);
  parts_->add_loads(mass, own.translation);
  parts_->add_body({name, BodyKind::slider, x, a, parts_->position_of(guide), 0., {}, own});
  return x;
}

void Machine::add_point_mass(const std::string &name, const std::string &marker_name, double mass,
                             const Vector3 &inertia, const Vector3 &offset)
{
  check_mass(mass, "point mass \"" + name + "\": mass [kg]");
  const Marker          &at = marker(marker_name);
  std::array<Measure, 3> moved;
  for (int d = 0; d < 3; ++d)
  {
    const int e = (d + 1) % 3, f = (d + 2) % 3; // (theta x r)_d = theta_e r_f - theta_f r_e
    moved[d] = at.translation[d] + offset[f] * at.rotation[e] - offset[e] * at.rotation[f];
  }
  parts_->add_mass(mass, moved);
  for (int d = 0; d < 3; ++d)
  {
    check_mass(inertia[d], "point mass \"" + name + "\": inertia [kg m^2]");
    parts_->add_dyad(parts_->M, inertia[d], at.rotation[d]);
  }
}

void Machine::draw(const std::string &body_name, const Vector3 &position, double radius, const Vector3 &size)
{
  for (Body &body : parts_->bodies)
    if (body.name == body_name)
    {
      body.position = position;
      body.radius   = radius;
      body.size     = size;
      return;
    }
  body(body_name); // throws with the nearest name
}

void Machine::draw_rod(const DrawnRod &rod)
{
  parts_->rods.push_back(rod);
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
                     const std::vector<Measure> &measures)
{
  if (static_cast<int>(measures.size()) != element->n_measures())
    throw std::invalid_argument("element \"" + name + "\" takes " + std::to_string(element->n_measures()) +
                                " measures, but " + std::to_string(measures.size()) + " were given");
  parts_->elements.push_back({name, std::move(element), measures});
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
const std::vector<ElementPlacement> &Machine::elements() const
{
  return parts_->elements;
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
  return parts_->n_frame + static_cast<int>(parts_->bodies.size());
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

std::unique_ptr<LinearSolver> Machine::factorise(double w_M, double w_B, double w_C) const
{
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
  const auto *dense = dynamic_cast<const DenseBase *>(parts_->base.get());
  if (!dense)
    return false;
  M = dense->mass();
  B = dense->damping();
  C = dense->stiffness();
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
  local.t           = t;
  local.u.noalias() = parts_->W.transpose() * q;
  local.v.noalias() = parts_->W.transpose() * v;
  local.a.noalias() = parts_->W.transpose() * a;
}

void Machine::local_force(const LocalState &state, Eigen::VectorXd &p) const
{
  for (const auto &part : parts_->placed)
    if (!part.holds)
      part.element->force(part.motion(state, parts_->by_history), parts_->history_of(part),
                          p.data() + part.first_measure);
}

void Machine::local_tangent(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                            Eigen::MatrixXd &dp) const
{
  dp.setZero();
  double block[Parts::max_measures * Parts::max_measures];
  for (const auto &part : parts_->placed)
  {
    if (part.holds)
      continue;
    part.element->tangent(part.motion(state, parts_->by_history), parts_->history_of(part), {w_u, w_v, w_a},
                          p.data() + part.first_measure, block);
    for (int j = 0; j < part.n_measures; ++j)
      for (int i = 0; i < part.n_measures; ++i)
        dp(part.first_measure + i, part.first_measure + j) = block[i + part.n_measures * j];
  }
}

void Machine::local_derivatives(const LocalState &state, Eigen::VectorXd &p, Eigen::MatrixXd &dp_du,
                                Eigen::MatrixXd &dp_dv) const
{
  double of_u[Parts::max_measures * Parts::max_measures], of_v[Parts::max_measures * Parts::max_measures];
  for (const auto &part : parts_->placed)
  {
    if (part.holds)
      continue;
    part.element->derivatives(part.motion(state, parts_->by_history), parts_->history_of(part),
                              p.data() + part.first_measure, of_u, of_v);
    for (int j = 0; j < part.n_measures; ++j)
      for (int i = 0; i < part.n_measures; ++i)
      {
        dp_du(part.first_measure + i, part.first_measure + j) = of_u[i + part.n_measures * j];
        dp_dv(part.first_measure + i, part.first_measure + j) = of_v[i + part.n_measures * j];
      }
  }
}

const std::vector<HeldMeasure> &Machine::held() const
{
  return parts_->held;
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
  parts_->refresh_guards();
}

void Machine::accept(const LocalState &state)
{
  for (const auto &part : parts_->placed)
    part.element->accept(part.motion(state, parts_->by_history), parts_->history_of(part));
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
    const double *history = parts_->history_of(part);
    const int     n       = part.element->n_guards(history);
    if (n > 0)
      part.element->guard_values(part.motion(state, parts_->by_history), history, g.data() + first);
    first += n;
  }
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
  const auto &part   = parts_->placed[active.element];
  part.element->transition(active.index, part.motion(state, parts_->by_history), parts_->history_of(part));
  parts_->refresh_guards();
}

double Machine::local_stored_energy(const LocalState &state) const
{
  double energy = 0.;
  for (const auto &part : parts_->placed)
    energy += part.element->stored_energy(part.motion(state, parts_->by_history), parts_->history_of(part));
  return energy;
}

void Machine::local_power(const LocalState &state, const Eigen::VectorXd &p, double &input, double &other) const
{
  input = other = 0.;
  for (const auto &part : parts_->placed)
  {
    const double power =
        p.segment(part.first_measure, part.n_measures).dot(state.v.segment(part.first_measure, part.n_measures));
    (part.element->work() == mechanism::Work::input ? input : other) += power;
  }
}

std::string Machine::coordinate_name(int i) const
{
  return parts_->coordinate_name(i);
}

} // namespace gestell::coupling

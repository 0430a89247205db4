#include "coupling/machine/machine.h"

#include "coupling/machine/dense_base.h"
#include "coupling/machine/machine_parts.h"
#include "coupling/machine/machine_system.h"
#include "coupling/machine/sparse_base.h"
#include "fem/values/nearest_name.h"

#include <cassert>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

MachineModel::MachineModel() : parts_(std::make_unique<MachineParts>())
{
  Marker ground;
  ground.name               = "ground";
  parts_->markers["ground"] = ground;
}

MachineModel::~MachineModel()                                   = default;
MachineModel::MachineModel(MachineModel &&) noexcept            = default;
MachineModel &MachineModel::operator=(MachineModel &&) noexcept = default;

Machine::Machine(MachineModel model)
    : model_(std::move(model)), parts_(model_.parts_.get()), system_(std::make_unique<MachineSystem>(*parts_))
{
  parts_->finish();
}

Machine::~Machine()                              = default;
Machine::Machine(Machine &&) noexcept            = default;
Machine &Machine::operator=(Machine &&) noexcept = default;

void MachineModel::set_frame(ReducedFrame frame)
{
  parts_->n_frame     = static_cast<int>(frame.M.rows());
  parts_->n_interface = frame.n_interface;
  parts_->own_modes   = turn_to_own_modes(frame);
  parts_->add_interfaces(frame.interfaces);
  parts_->reduced = std::make_unique<ReducedFrame>(std::move(frame));
}

void MachineModel::set_frame(fem::FrameMatrices frame)
{
  parts_->n_frame     = static_cast<int>(frame.M.rows());
  parts_->n_interface = static_cast<int>(frame.interface_coordinates().size());
  parts_->add_interfaces(frame.interfaces);
  parts_->full = std::make_unique<fem::FrameMatrices>(std::move(frame));
}

void MachineModel::set_gravity(const Vector3 &g)
{
  parts_->gravity = g;
}

void MachineModel::add_linear(const std::string &name, const Measure &u, const LinearLaw &law,
                              const std::string &force_unit)
{
  const auto &[stiffness, damping, preload, rest] = law;
  parts_->add_dyad(parts_->C, stiffness, u);
  parts_->add_dyad(parts_->B, damping, u);
  for (const auto &[coordinate, weight] : u)
    parts_->constant_load.emplace_back(coordinate, weight * (stiffness * rest - preload));
  parts_->linear.push_back({name, u, stiffness, damping, preload - stiffness * rest, force_unit});
}

void MachineModel::add_load(const std::string &name, const Measure &u, double constant,
                            const std::vector<Oscillation> &oscillations, const std::string &force_unit)
{
  for (const Oscillation &part : oscillations)
    if (!(part.omega > 0.))
      throw std::invalid_argument("load \"" + name + "\": circular frequency " + std::to_string(part.omega) +
                                  " rad/s must be positive; give a constant load as such");
  for (const auto &[coordinate, weight] : u)
    parts_->constant_load.emplace_back(coordinate, weight * constant);
  parts_->loads.push_back({name, force_unit, u, constant, oscillations});
}

int MachineModel::add_lag(const std::string &name, double time_constant)
{
  if (!(time_constant > 0.) || !std::isfinite(time_constant))
    throw std::invalid_argument("lag \"" + name + "\": time constant " + std::to_string(time_constant) +
                                " s must be positive");
  const int x = parts_->size();
  parts_->add_dyad(parts_->B, time_constant, {{x, 1.}});
  parts_->add_dyad(parts_->C, 1., {{x, 1.}});
  parts_->coordinate_names.push_back(name);
  parts_->lag_coordinates.push_back(x);
  return x;
}

void MachineModel::attach(const std::string &name, std::shared_ptr<mechanism::Element> element,
                          const std::vector<Measure> &measures, MeasureKind kind)
{
  if (static_cast<int>(measures.size()) != element->n_measures())
    throw std::invalid_argument("element \"" + name + "\" takes " + std::to_string(element->n_measures()) +
                                " measures, but " + std::to_string(measures.size()) + " were given");
  parts_->elements.push_back({name, std::move(element), measures, -1, kind});
}

void MachineModel::attach_friction(std::shared_ptr<mechanism::ForceLaw> element, const std::vector<Measure> &measures)
{
  const int joint = static_cast<int>(parts_->elements.size()) - 1;
  assert(joint >= 0 && parts_->elements[joint].element->ideal_joint());
  attach(std::string(parts_->elements[joint].name), std::move(element), measures);
  parts_->elements.back().joint = joint;
}

const Marker &MachineModel::marker(const std::string &name) const
{
  const auto found = parts_->markers.find(name);
  if (found != parts_->markers.end())
    return found->second;
  std::vector<std::string> names;
  for (const auto &entry : parts_->markers)
    names.push_back(entry.first);
  throw std::invalid_argument("there is no body or interface \"" + name + "\"" + suggestion(name, names));
}

const Body &MachineModel::body(const std::string &name) const
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

const std::vector<Body> &MachineModel::bodies() const
{
  return parts_->bodies;
}
const std::vector<DrawnRod> &MachineModel::rods() const
{
  return parts_->rods;
}
const std::vector<DrawnBar> &MachineModel::bars() const
{
  return parts_->bars;
}
const std::vector<DrawnPin> &MachineModel::pins() const
{
  return parts_->pins;
}
const std::vector<ElementPlacement> &MachineModel::elements() const
{
  return parts_->elements;
}
const std::vector<Switch> &MachineModel::switches() const
{
  return parts_->switch_requests;
}
const ReducedFrame *MachineModel::reduced_frame() const
{
  return parts_->reduced.get();
}
const fem::FrameMatrices *MachineModel::full_frame() const
{
  return parts_->full.get();
}
int MachineModel::n_frame() const
{
  return parts_->n_frame;
}
int MachineModel::n_mechanism() const
{
  return static_cast<int>(parts_->coordinate_names.size());
}
int MachineModel::n_interface() const
{
  return parts_->n_interface;
}
Eigen::MatrixXd Machine::translation_loads() const
{
  return parts_->translation_loads;
}

void Machine::gather(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const Eigen::VectorXd &a,
                     LocalState &local) const
{
  if (local.p.size() != parts_->W.cols())
    local.p.setZero(parts_->W.cols());
  if (local.lambda.size() != joints().n_rows())
    local.lambda.setZero(joints().n_rows());
  local.t           = t;
  local.u.noalias() = parts_->W.transpose() * q;
  local.v.noalias() = parts_->W.transpose() * v;
  local.a.noalias() = parts_->W.transpose() * a;
}

void Machine::geometric(const LocalState &state, Eigen::MatrixXd &K) const
{
  K.setZero(parts_->W.cols(), parts_->W.cols());
  double block[MachineParts::max_measures * MachineParts::max_measures];
  for (const auto &part : parts_->placed)
  {
    mechanism::geometric(*part.element, part.motion(state, parts_->by_history), parts_->history_of(part), block);
    K.block(part.first_measure, part.first_measure, part.n_measures, part.n_measures) =
        Eigen::Map<const Eigen::MatrixXd>(block, part.n_measures, part.n_measures);
  }
}

std::vector<std::string> Machine::closed_contacts(const LocalState &state) const
{
  std::vector<std::string> closed;
  for (std::size_t e = 0; e < parts_->placed.size(); ++e)
  {
    const auto  &part = parts_->placed[e];
    const double deep = part.structure ? part.structure->penetration(part.motion(state, false)) : 0.;
    // [m, rad] A contact that just touches in the scene may be closed by rounding.  Absolute, only for a warning: an
    // initial penetration of a nanometre causes no significant force.
    constexpr double touching = 1e-9;
    if (deep <= touching)
      continue;
    std::ostringstream words;
    words << "\"" << parts_->elements[e].name << "\" by " << deep << " (m or rad)";
    closed.push_back(words.str());
  }
  return closed;
}

int MachineModel::size() const
{
  return parts_->size();
}
const LinearSystem &Machine::linear() const
{
  return system_->linear;
}
const LocalForces &Machine::forces() const
{
  return system_->forces;
}
const IdealJoints &Machine::joints() const
{
  return system_->joints;
}
const EventSystem &Machine::events() const
{
  return system_->events;
}
EventSystem &Machine::events()
{
  return system_->events;
}
const EnergyAccount &Machine::energy() const
{
  return system_->energy;
}

std::string MachineModel::coordinate_name(int i) const
{
  return parts_->coordinate_name(i);
}

} // namespace gestell::coupling

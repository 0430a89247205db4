#include "apps/scene/build/build_machine.h"

#include "coupling/equilibrium/static_equilibrium.h"
#include "coupling/machine/configuration/assembly.h"
#include "coupling/machine/configuration/loop_closure.h"
#include "coupling/machine/configuration/plays.h"
#include "mechanism/joints/orthonormal_directors.h"

#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <map>

namespace gestell::apps
{
namespace
{

std::vector<fem::Interface> interfaces_of(const coupling::Machine &machine)
{
  return machine.model().reduced_frame() ? machine.model().reduced_frame()->interfaces
         : machine.model().full_frame()  ? machine.model().full_frame()->interfaces
                                         : std::vector<fem::Interface>{};
}

/// Adds `value` for a coordinate of a body, or for a motion of an interface: q[coordinate] = sign * motion.
int set_coordinate(Eigen::VectorXd &x, const NamedValue &value, const coupling::Machine &machine)
{
  for (int i = 0; i < machine.size(); ++i)
    if (machine.coordinate_name(i) == value.name)
    {
      x[i] = coordinate_sign(machine, i) * value.value;
      return i;
    }
  static const std::vector<std::string> motions{"ux", "uy", "uz", "rx", "ry", "rz"};
  const auto                            dot = value.name.rfind('.');
  const auto motion = std::find(motions.begin(), motions.end(), value.name.substr(dot + 1)) - motions.begin();
  for (const auto &interface : interfaces_of(machine))
    if ("frame." + interface.name == value.name.substr(0, dot) && motion < 6)
    {
      const int i = interface.coordinate[motion];
      if (i < 0)
        throw std::invalid_argument(value.place + ": this DOF of the frame is fixed");
      x[i] = interface.sign[motion] * value.value;
      return i;
    }
  throw std::invalid_argument(value.place + ": there is no coordinate '" + value.name +
                              "'; give a body or \"frame.NAME.uz\"");
}

/// The rigid body and the axis of a rotation `name` ("top.rx") or an angular velocity ("top.wx").
const coupling::Body *turning_body(const coupling::Machine &machine, const std::string &name, char letter, int &axis)
{
  const auto dot = name.rfind('.');
  if (dot == std::string::npos || name.size() != dot + 3 || name[dot + 1] != letter)
    return nullptr;
  axis = name[dot + 2] - 'x';
  for (const coupling::Body &body : machine.model().bodies())
    if (body.kind == coupling::BodyKind::rigid && body.name == name.substr(0, dot))
      return &body;
  return nullptr;
}

/// Sets the given coordinates in q; a rotation of a rigid body is given as a whole, by up to three values.
void set_position(const std::vector<NamedValue> &values, const coupling::Machine &machine, Eigen::VectorXd &q,
                  const std::function<void(int)> &mark)
{
  std::map<int, Eigen::Vector3d> rotations; // by the first coordinate of the directors
  for (const auto &value : values)
  {
    int axis = 0;
    if (const coupling::Body *body = turning_body(machine, value.name, 'r', axis))
    {
      auto &rotation = rotations.emplace(body->coordinate + 3, Eigen::Vector3d::Zero()).first->second;
      rotation[axis] = value.value;
    }
    else if (!value.measure)
      mark(set_coordinate(q, value, machine));
  }
  using mechanism::OrthonormalDirectors;
  for (const auto &[first, rotation] : rotations)
  {
    Eigen::Map<Eigen::Matrix3d>(q.data() + first) = OrthonormalDirectors::measures(rotation);
    for (int i = 0; i < OrthonormalDirectors::n_directors; ++i)
      mark(first + i);
  }
}

coupling::KnownStart known_start(const Scene &scene, const coupling::Machine &machine, const std::vector<NamedValue> &q,
                                 const std::vector<NamedValue> &v)
{
  coupling::KnownStart known;
  known.state.t = scene.run.options.begin;
  known.state.q = known.state.v = Eigen::VectorXd::Zero(machine.size());
  known.q_given.assign(machine.size(), 0);
  known.v_given = known.q_given;
  for (const auto &value : q)
    if (value.measure)
      known.measures.emplace_back(value.name, value.value);
  set_position(q, machine, known.state.q, [&known](int i) { known.q_given[i] = 1; });
  int axis = 0;
  for (const auto &value : v)
    if (value.measure)
      known.rates.emplace_back(value.name, value.value);
    else if (const coupling::Body *body = turning_body(machine, value.name, 'w', axis))
      known.spins.push_back({body->name, axis, value.value});
    else
      known.v_given[set_coordinate(known.state.v, value, machine)] = 1;
  return known;
}

coupling::InitialState assembled(const Scene &scene, coupling::Machine &machine, const coupling::KnownStart &known)
{
  try
  {
    return coupling::assemble(machine, known);
  }
  catch (const std::invalid_argument &e)
  {
    throw against_start(scene, e.what());
  }
}

/// Whether a steady initial state is given by rotors, or by q and v.
bool by_rotors(const StartRequest &start)
{
  return start.rule == StartRule::steady && start.q.empty() && start.v.empty();
}

bool has_speed(const StartRequest &start)
{
  return std::any_of(start.v.begin(), start.v.end(), [](const NamedValue &v) { return v.value != 0.; });
}

} // namespace

double coordinate_sign(const coupling::Machine &machine, int i)
{
  for (const fem::Interface &interface : interfaces_of(machine)) // the first one, as in coordinate_name()
    for (int motion = 0; motion < 6; ++motion)
      if (interface.coordinate[motion] == i)
        return interface.sign[motion];
  return 1.;
}

std::invalid_argument against_start(const Scene &scene, const std::string &message)
{
  for (const auto &[name, place] : scene.element_places)
    if (message.find("\"" + name + "\"") != std::string::npos)
      return std::invalid_argument(place + ": " + message);
  return std::invalid_argument(scene.start.place + ": " + message);
}

void check_start_names(const Scene &scene, const coupling::Machine &machine)
{
  known_start(scene, machine, scene.start.q, scene.start.v);
  known_start(scene, machine, scene.modes.at, {});
}

coupling::InitialState initial_state(const Scene &scene, coupling::Machine &machine)
{
  const StartRequest        &start = scene.start;
  const coupling::KnownStart known = known_start(scene, machine, start.q, start.v);
  const auto                 found = [&]() -> coupling::InitialState
  {
    if (by_rotors(start))
    {
      coupling::SteadyStart steady = start.steady;
      steady.t                     = scene.run.options.begin;
      return coupling::steady_start(machine, steady);
    }
    if (start.rule == StartRule::steady)
      return coupling::steady_start(machine, known);
    const coupling::InitialState state = coupling::assemble(machine, known);
    if (start.rule == StartRule::given)
      return state;
    return coupling::static_equilibrium(
        machine, state, start.drift ? coupling::Drift::quasistatic : coupling::Drift::none,
        start.inertia_relief ? coupling::Floating::relieved : coupling::Floating::refused);
  };
  try
  {
    coupling::InitialState state = found();
    state.t                      = scene.run.options.begin;
    state.settled                = start.rule != StartRule::given;
    if (start.rule == StartRule::given && !start.periodic) // other speeds follow from loads, or from the orbit
      for (std::string &warning : coupling::closing_warnings(machine, known.v_given, state.q, state.v))
        state.notes.push_back(std::move(warning));
    if (start.rule == StartRule::rest && has_speed(start))
      state.notes.push_back("start.v is not used with rule = \"static\", which starts at rest; use \"steady\", or "
                            "\"given\" with the positions of the equilibrium");
    return state;
  }
  catch (const std::invalid_argument &e)
  {
    throw against_start(scene, e.what());
  }
}

coupling::KnownStart modes_position(const Scene &scene, coupling::Machine &machine)
{
  coupling::KnownStart known = known_start(scene, machine, scene.modes.at, {});
  known.state.q              = modes_configuration(scene, machine);
  known.state.t              = scene.run.options.begin;
  return known;
}

Eigen::VectorXd modes_configuration(const Scene &scene, coupling::Machine &machine)
{
  // With joints the initial position must be assembled: at the start, or closest to it.
  if (coupling::has_joints(machine) && scene.modes.at.empty())
    return initial_state(scene, machine).q;
  const bool measured =
      std::any_of(scene.modes.at.begin(), scene.modes.at.end(), [](const NamedValue &value) { return value.measure; });
  if (coupling::has_joints(machine) || measured)
  {
    coupling::KnownStart known = known_start(scene, machine, scene.modes.at, {});
    known.state.q              = initial_state(scene, machine).q;
    set_position(scene.modes.at, machine, known.state.q, [](int) {});
    return assembled(scene, machine, known).q;
  }
  Eigen::VectorXd q = Eigen::VectorXd::Zero(machine.size());
  for (const auto &value : scene.modes.at)
    set_coordinate(q, value, machine);
  coupling::close_chains(machine, q); // moves bodies that follow a crank, such as a slide
  return q;
}

} // namespace gestell::apps

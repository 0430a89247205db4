#include "apps/scene/build/build_machine.h"

#include "apps/scene/bodies/body_types.h"
#include "apps/scene/build/build_measures.h"
#include "apps/scene/build/carried_bodies.h"
#include "apps/scene/build/tangent_measures.h"
#include "apps/scene/joints/compliance.h"
#include "apps/scene/joints/joint_friction.h"
#include "apps/scene/joints/joint_types.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/scene/language/quantity.h"
#include "apps/scene/values/requests.h"
#include "coupling/machine/machine.h"
#include "coupling/reduction/dense_frame.h"
#include "mechanism/elements/unbalance.h"
#include "mechanism/transmitted_element.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <regex>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using mechanism::RelativeMeasure;

/// Adds the shape of a joint: a bar, a pin; for others only their points.
void draw_joint(coupling::MachineModel &machine, const JointRequest &joint, JointType::Drawn drawn, const Pair &pair)
{
  draw_places(machine, joint.from, joint.to);
  if (drawn == JointType::Drawn::bar)
    machine.draw_bar({joint.name, placed(machine, joint.from), placed(machine, joint.to)});
  if (drawn != JointType::Drawn::pin)
    return;
  if (joint.axis != Vector3{})
    machine.draw_pin({placed(machine, joint.from), joint.axis});
  else if (const coupling::Body *body = pair.planar())
    machine.draw_pin({placed(machine, joint.from), body->axis});
}

/// The level of a switch must have the unit of its signal.
void check_level(const coupling::MachineModel &machine, const SwitchRequest &request, const Quantity &level,
                 const std::string &what)
{
  const coupling::Signal signal = machine.signal(request.request.name, request.request.signal);
  if (!level.checked || signal.unit.empty() || signal.unit == "1")
    return;
  const Quantity unit = parse_quantity("1 " + signal.unit, [](const std::string &) { return std::nullopt; });
  if (!equal(unit.dimension, level.dimension))
    throw std::invalid_argument("the signal \"" + request.request.signal + "\" is in " + signal.unit + ", but the " +
                                what + " is " + describe(level.dimension));
  const Kind kind{what + " of a signal in " + signal.unit, "20 1/min", unit.dimension,
                  unit.counts == Counts::radians ? Counts::turns : Counts::nothing};
  value_as(level, kind, describe(level.dimension));
}

/// The joints and switches of a scene, in the machine; bodies and elements must be there.
void add_joint(coupling::MachineModel &machine, const JointRequest &joint)
{
  if (joint.is_scalar())
  {
    add_measure_joint(machine, joint);
    return;
  }
  const JointType &type = joint_type(joint.type);
  const Pair       pair(machine, joint.from, joint.to);
  const bool       directed = joint.compliance && joint.compliance->directed;
  JointEquations   equations(pair, directed, carrier_of(joint, pair));
  type.demand(equations, joint);
  if (equations.list.empty())
    throw std::invalid_argument("constrains nothing: neither body has a DOF in the constrained directions");
  Pair felt = pair;
  equations.leave_out_idle(felt);
  if (joint.compliance)
  {
    equations.join_translations(felt);
    const auto yielding = compliant_joint(joint, equations, felt);
    machine.attach(joint.name, yielding, felt.measures);
  }
  else
    machine.attach(joint.name,
                   std::make_shared<mechanism::IdealJoint>(felt.first, felt.second, equations.list, joint.law),
                   felt.measures);
  if (joint.friction)
    add_joint_friction(machine, joint, type.friction, pair, equations.list);
  draw_joint(machine, joint, type.drawn, pair);
}

/// Attaches a law on the common tangents of two wheels.
void attach_on_tangents(coupling::MachineModel &machine, const ElementRequest &element)
{
  const PairRequest     &request = *element.pair;
  const TangentsRequest &wheels  = *request.tangents;
  const Pair             described(machine, request.from, request.to);
  const double           distance = centre_distance(described.first, described.second, vector(wheels.axis));
  const PlaceRequest     from     = on_own_axis(machine, request.from, distance),
                     to           = on_own_axis(machine, request.to, distance);
  const Pair pair(machine, from, to);
  machine.attach(element.name,
                 std::make_shared<mechanism::TransmittedElement>(pair.first, pair.second,
                                                                 tangent_measures(wheels, pair), element.element),
                 pair.measures);
  draw_places(machine, from, to);
}

/// Attaches a law that acts between two places, on the measures of its PairRequest.
void attach_between(coupling::MachineModel &machine, const ElementRequest &element)
{
  const PairRequest           &request = *element.pair;
  const Pair                   pair(machine, request.from, request.to);
  std::vector<RelativeMeasure> measures;
  const coupling::Body        *planar = pair.planar();
  if (request.about && planar && std::abs(vector(planar->axis).dot(vector(*request.about))) < 1. - 1e-9)
    throw std::invalid_argument("its axis must be normal to the plane of \"" + planar->name +
                                "\", which rotates about its normal only");
  for (const Vector3 &a : request.along)
    measures.push_back(seen_from_first(vector(a)));
  if (request.about)
    measures.push_back(pair.in_space() ? angle_about(vector(*request.about))
                                       : rotation_about(pair, vector(*request.about), 1.));
  machine.attach(
      element.name,
      std::make_shared<mechanism::TransmittedElement>(pair.first, pair.second, std::move(measures), element.element),
      pair.measures);
  draw_places(machine, request.from, request.to);
  if (request.about)
    machine.draw_pin({placed(machine, request.to), *request.about});
}

void add_switch(coupling::MachineModel &machine, const SwitchRequest &request)
{
  machine.add_switch(request.request); // throws for a missing signal with its own message
  check_level(machine, request, request.level, "level");
  if (request.hysteresis)
    check_level(machine, request, *request.hysteresis, "hysteresis");
}

using coupling::operator*, coupling::operator+; // of measures

Vector3 cross(const Vector3 &a, const Vector3 &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector3 &a, const Vector3 &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// e . (translation + rotation x arm) = e . translation + (arm x e) . rotation
coupling::Measure moved_along(const Vector3 &e, const coupling::Marker &marker, const Vector3 &arm)
{
  const Vector3     turned = cross(arm, e);
  coupling::Measure u;
  for (int d = 0; d < 3; ++d)
    u = u + e[d] * marker.translation[d] + turned[d] * marker.rotation[d];
  return u;
}

/// Points away from the axis of a carrier with large rotations move along circles, not straight lines.
void refuse_carried_round(const coupling::MachineModel &machine, const BodyRequest &rotor, const Vector3 &arm)
{
  for (const coupling::Body &body : machine.bodies())
    if (body.name == rotor.carrier && body.kind != coupling::BodyKind::slider &&
        body.kind != coupling::BodyKind::point && dot(cross(arm, body.axis), cross(arm, body.axis)) > 0.)
      throw std::invalid_argument("the unbalance is off the axis of \"" + rotor.carrier +
                                  "\", which rotates through large angles and would move it; put unbalance_position on "
                                  "this axis, or carry the rotor by a separate body");
}

/// Attaches the unbalance of a rotor as an element "NAME unbalance": along e_1, the first global axis across the
/// rotor's axis a, and e_2 = a x e_1.
/// @throws std::invalid_argument for an unbalance off the axis of a carrier that turns through any angle
void attach_unbalance(coupling::MachineModel &machine, const BodyRequest &rotor, const Vector3 &gravity)
{
  const coupling::Marker &carrier = machine.marker(rotor.carrier);
  const Vector3           e_1 = coupling::plane_across(rotor.axis).first, e_2 = cross(rotor.axis, e_1);
  Vector3                 arm{};
  if (rotor.unbalance->position && rotor.carrier != "ground")
  {
    const Vector3 origin = machine.position(rotor.carrier);
    for (int d = 0; d < 3; ++d)
      arm[d] = (*rotor.unbalance->position)[d] - origin[d];
  }
  refuse_carried_round(machine, rotor, arm);
  mechanism::Unbalance::Parameters own;
  own.unbalance  = rotor.unbalance->amount;
  own.phase      = rotor.unbalance->phase;
  own.gravity[0] = dot(gravity, e_1);
  own.gravity[1] = dot(gravity, e_2);
  machine.attach(
      rotor.name + " unbalance", std::make_shared<mechanism::Unbalance>(own),
      {{{machine.body(rotor.name).coordinate, 1.}}, moved_along(e_1, carrier, arm), moved_along(e_2, carrier, arm)});
}

/// Adds the location in the scene to errors about a name.
template <typename Make>
auto placed(const std::string &place, Make make)
{
  try
  {
    return make();
  }
  catch (const std::invalid_argument &e)
  {
    throw std::invalid_argument(place + ": " + e.what());
  }
}

void add_body(coupling::MachineModel &machine, const BodyRequest &body)
{
  check_carrier(machine, body);
  body_type(body.kind).add(machine, body);
  machine.draw(body.name, body.position, body.radius, body.size);
}

void fill(coupling::MachineModel &machine, const Scene &scene)
{
  for (const auto &body : scene.bodies)
    placed(body.place, [&] { add_body(machine, body); });
  const auto place = [&](const std::string &element) { return scene.element_places.at(element); };
  for (const auto &point : scene.point_masses)
    placed(place(point.name),
           [&] { machine.add_point_mass(point.name, point.marker, point.mass, point.inertia, point.offset); });
  for (const auto &spring : scene.linear)
    placed(place(spring.name),
           [&]
           {
             machine.add_linear(spring.name, measures_of({spring.u}, machine).front(),
                                {spring.stiffness, spring.damping, spring.preload, spring.rest}, spring.force_unit);
           });
  for (const auto &load : scene.loads)
    placed(place(load.name),
           [&]
           {
             machine.add_load(load.name, measures_of({load.u}, machine).front(), load.constant, load.oscillations,
                              load.force_unit);
           });
  for (const auto &point : scene.places)
    if (point.point.marker != "ground")
      placed(point.place, [&] { machine.add_place(point.name, apps::placed(machine, point.point)); });
  add_measures(machine, scene);
  for (const auto &joint : scene.joints)
    placed(joint.place, [&] { add_joint(machine, joint); });
  for (const auto &element : scene.elements)
    placed(place(element.name),
           [&]
           {
             if (!element.on.empty() || element.own)
             {
               attach_on_measure(machine, element);
               return;
             }
             if (element.pair)
             {
               element.pair->tangents ? attach_on_tangents(machine, element) : attach_between(machine, element);
               return;
             }
             auto measures = measures_of(element.measures, machine);
             for (const auto &lag : element.lags)
               measures.push_back({{machine.add_lag(lag.name, lag.time_constant), 1.}});
             machine.attach(element.name, element.element, measures, element.kind);
           });
  for (const auto &body : scene.bodies)
    if (body.unbalance)
      placed(body.place, [&] { attach_unbalance(machine, body, scene.gravity); });
  for (const auto &own : scene.switches)
    placed(own.place, [&] { add_switch(machine, own); });
  for (const auto &rod : scene.rods)
    machine.draw_rod(rod);
}

template <typename Frame>
coupling::Machine machine_on(const Scene &scene, Frame frame)
{
  coupling::MachineModel machine;
  machine.set_gravity(scene.gravity);
  machine.set_frame(std::move(frame));
  fill(machine, scene);
  return coupling::Machine(std::move(machine));
}

} // namespace

FramePath frame_path(const Scene &scene)
{
  const bool reduce = scene.reduction.reduces();
  switch (scene.frame.source)
  {
  case FrameSource::none:
    return FramePath::none;
  case FrameSource::parts:
    return FramePath::reduce;
  case FrameSource::geometry:
    return reduce ? FramePath::reduce : FramePath::sparse;
  case FrameSource::reduced_file:
    return FramePath::from_file;
  case FrameSource::matrices:
    break;
  }
  constexpr Eigen::Index largest_dense_frame = 500; // coordinates; above, sparse solves win
  return reduce                                                 ? FramePath::reduce
         : scene.frame.matrices.M.rows() <= largest_dense_frame ? FramePath::dense
                                                                : FramePath::sparse;
}

coupling::Machine build_machine(const Scene &scene)
{
  if (scene.frame.source == FrameSource::matrices)
    return machine_on(scene, placed(scene.frame.place, [&] { return coupling::dense_frame(scene.frame.matrices); }));
  if (scene.bodies.empty())
    throw std::invalid_argument(scene.file + ": has no moving part; declare a [frame] or at least one [body.NAME]");
  coupling::MachineModel machine;
  machine.set_gravity(scene.gravity);
  fill(machine, scene);
  return coupling::Machine(std::move(machine));
}

coupling::Machine build_machine(const Scene &scene, coupling::ReducedFrame frame)
{
  return machine_on(scene, std::move(frame));
}

coupling::Machine build_machine(const Scene &scene, fem::FrameMatrices frame)
{
  return machine_on(scene, std::move(frame));
}

namespace
{

/// "-frame.crown.uz_rate"; names may have any length, which std::regex cannot take.
bool is_motion_of_interface(const std::string &path)
{
  static const std::regex motion("[ur][xyz](_rate|_acceleration)?");
  const std::size_t       first = path.find('.'), last = path.rfind('.');
  return (path.compare(0, first, "frame") == 0 || path.compare(0, first, "-frame") == 0) && last > first + 1 &&
         std::regex_match(path.substr(last + 1, 32), motion);
}

/// Refuses a motion that an interface of the frame does not have.
void require_motion(const coupling::Signal &signal, const std::string &path)
{
  if (signal.on_q.empty() && signal.on_v.empty() && signal.on_a.empty() && is_motion_of_interface(path))
    throw std::invalid_argument("signal \"" + signal.name + "\": '" + path +
                                "' is always zero, because the frame has no such DOF at this interface; name another "
                                "one, or remove the signal");
}

coupling::Signal signal_of_user(const SignalRequest &request, const coupling::Machine &machine)
{
  std::vector<coupling::Signal> of;
  for (const std::string &path : request.of)
    of.push_back(machine.signal(request.name, path));
  return coupling::computed_signal(request.name, request.user->unit, request.user->value, of);
}

} // namespace

std::vector<coupling::Signal> scene_signals(const Scene &scene, const coupling::Machine &machine)
{
  std::vector<coupling::Signal> signals;
  for (const auto &request : scene.signals)
  {
    if (request.user)
    {
      signals.push_back(placed(request.place, [&] { return signal_of_user(request, machine); }));
      continue;
    }
    signals.push_back(placed(request.place, [&] { return machine.signal(request.name, request.path); }));
    placed(request.place, [&] { require_motion(signals.back(), request.path); });
    signals.back().from = request.from;
  }
  return signals;
}

} // namespace gestell::apps

#include "apps/session/forces/force_places.h"

#include "apps/scene/build/build_measures.h"
#include "apps/scene/joints/joint_types.h"

#include <algorithm>
#include <set>

namespace gestell::apps
{

namespace
{

using coupling::BodyKind;
using coupling::MachineModel;
using coupling::PlacedPoint;
using Eigen::Vector3d;

std::set<int> moved_by(const coupling::PlacedPoint &place)
{
  std::set<int> coordinates;
  for (const coupling::Measure &measure : place.measures)
    for (const auto &[coordinate, weight] : measure)
      if (weight != 0.)
        coordinates.insert(coordinate);
  return coordinates;
}

std::vector<int> without(const std::set<int> &all, const std::set<int> &others)
{
  std::vector<int> own;
  std::set_difference(all.begin(), all.end(), others.begin(), others.end(), std::back_inserter(own));
  return own;
}

constexpr double negligible = 1e-12; ///< of a direction: rounding of its parts

bool turns(const MotionMeasure &motion)
{
  return std::all_of(motion.begin(), motion.end(), [](const MotionTerm &term) { return term.rotation; });
}

bool is_carried(const BodyRequest &body)
{
  return body.kind == BodyKind::rotor || body.kind == BodyKind::slider;
}

std::string carrier_of(const BodyRequest &body)
{
  return body.carrier.empty() ? "ground" : body.carrier;
}

/// Gathers the places while it goes through the measures of the machine.
class Places
{
public:
  Places(const Scene &scene, const coupling::Machine &machine)
      : scene_(scene), machine_(machine), model_(machine.model())
  {
  }

  ForcePlaces all()
  {
    for (const coupling::ElementPlacement &element : model_.elements())
    {
      add(element);
      next_ += int(element.measures.size());
    }
    for (const LinearRequest &spring : scene_.linear)
      add_signal(spring.name, spring.u, -1.);
    for (const LoadRequest &load : scene_.loads)
      add_signal(load.name, load.u, 1.);
    for (const BodyRequest &body : scene_.bodies)
      if (is_carried(body))
        add_bearing(body);
    return std::move(places_);
  }

private:
  void add(const coupling::ElementPlacement &element);
  void add_joint(const JointRequest &joint, const coupling::ElementPlacement &element);
  void add_element(const ElementRequest &request, const coupling::ElementPlacement &element);
  void add_measure(const MeasureRequest &request, const coupling::ElementPlacement &element);
  int  add_term(const TermRequest &term, const coupling::ElementPlacement &element, int from);
  void add_motion(const std::string &name, const MotionMeasure &motion, int measure, bool turns_alone);
  void add_signal(const std::string &name, const MotionMeasure &motion, double sign);
  void add_between(const std::string &name, const PlaceRequest &from, const PlaceRequest &to,
                   const coupling::ElementPlacement &element, int begin, int end, bool is_load = false);
  void add_bearing(const BodyRequest &body);

  PlacedPoint place(const std::string &marker) const { return placed(model_, {marker, std::nullopt}); }
  ForceAlong  along(const std::string &name, const std::string &body, const Vector3d &direction, bool turns) const;
  std::vector<ForceAlong> shared(const std::string &name, const std::string &body, const Vector3d &direction,
                                 bool turns) const;
  std::vector<ForceAlong> all_along(const std::string &name, const MotionMeasure &motion, bool turns_alone) const;

  const Scene             &scene_;
  const coupling::Machine &machine_;
  const MachineModel      &model_;
  ForcePlaces              places_;
  int                      next_ = 0; ///< first measure of the element
};

template <typename Requests>
auto named(const Requests &requests, const std::string &name)
{
  return std::find_if(requests.begin(), requests.end(), [&](const auto &one) { return one.name == name; });
}

void Places::add(const coupling::ElementPlacement &element)
{
  if (const auto joint = named(scene_.joints, element.name); joint != scene_.joints.end())
    add_joint(*joint, element);
  else if (const auto request = named(scene_.elements, element.name); request != scene_.elements.end())
    add_element(*request, element);
}

void Places::add_joint(const JointRequest &joint, const coupling::ElementPlacement &element)
{
  if (joint.is_scalar())
    add_measure(joint.measure, element);
  else
    add_between(element.joint >= 0 ? joint.name + " friction" : joint.name, joint.from, joint.to, element, 0,
                int(element.measures.size()));
  if (!joint.is_scalar() && joint_type(joint.type).is_coupling)
    places_.between.back().is_coupling = true;
}

void Places::add_element(const ElementRequest &request, const coupling::ElementPlacement &element)
{
  const int n = int(element.measures.size());
  if (request.follows)
    add_between(request.name, request.own->second, request.own->second, element, 0, n, true);
  else if (request.own)
    add_measure(*request.own, element);
  else if (!request.on.empty())
  {
    if (const auto measure = named(scene_.measures, request.on); measure != scene_.measures.end())
      add_measure(*measure, element);
  }
  else if (request.pair)
    add_between(request.name, request.pair->from, request.pair->to, element, 0, n);
  else
  {
    const bool turns_alone = std::all_of(request.measures.begin(), request.measures.end(), turns);
    for (std::size_t i = 0; i < request.measures.size(); ++i)
      add_motion(request.name, request.measures[i], next_ + int(i), turns_alone);
  }
}

void Places::add_measure(const MeasureRequest &request, const coupling::ElementPlacement &element)
{
  if (request.terms.empty())
  {
    add_between(element.name, request.first, request.second, element, 0, int(element.measures.size()));
    return;
  }
  int from = 0;
  for (const TermRequest &term : request.terms)
    from = add_term(term, element, from);
  if (request.function)
    add_term(request.argument, element, from);
}

/// @return the index after its last measure
int Places::add_term(const TermRequest &term, const coupling::ElementPlacement &element, int from)
{
  if (!term.placed)
  {
    add_motion(element.name, term.motion, next_ + from, turns(term.motion));
    return from + 1;
  }
  const int end = from + int(placed(model_, term.placed->first).measures.size() +
                             placed(model_, term.placed->second).measures.size());
  add_between(element.name, term.placed->first, term.placed->second, element, from, end);
  return end;
}

void Places::add_bearing(const BodyRequest &body)
{
  const std::string carrier = carrier_of(body);
  places_.bearings.push_back(
      {body.name, carrier, place(body.name), place(carrier), vector(body.axis), body.kind == BodyKind::rotor});
}

ForceAlong Places::along(const std::string &name, const std::string &body, const Vector3d &direction, bool turns) const
{
  ForceAlong along;
  along.name      = name;
  along.body      = body;
  along.at        = place(body);
  along.direction = direction;
  along.turns     = turns;
  return along;
}

/// A rotor rotates about its axis and a slider moves along it; all other motions are those of the carrier.
std::vector<ForceAlong> Places::shared(const std::string &name, const std::string &body, const Vector3d &direction,
                                       bool turns) const
{
  const auto request = named(scene_.bodies, body);
  if (request == scene_.bodies.end() || !is_carried(*request))
    return {along(name, body, direction, turns)};
  const Vector3d axis   = vector(request->axis);
  const bool     is_own = turns == (request->kind == BodyKind::rotor);
  const Vector3d own = is_own ? Vector3d(axis.dot(direction) * axis) : Vector3d::Zero(), rest = direction - own;
  std::vector<ForceAlong> all;
  if (own.norm() > negligible * direction.norm())
    all.push_back(along(name, body, own, turns));
  if (rest.norm() > negligible * direction.norm())
    for (ForceAlong &part : shared(name, carrier_of(*request), rest, turns))
      all.push_back(std::move(part));
  return all;
}

/// Includes the ground if the terms do not balance each other.  A torque together with forces, as for a connecting rod,
/// is balanced by their levers.
std::vector<ForceAlong> Places::all_along(const std::string &name, const MotionMeasure &motion, bool turns_alone) const
{
  std::vector<ForceAlong> all;
  Vector3d                force = Vector3d::Zero(), torque = Vector3d::Zero();
  for (const MotionTerm &term : motion)
  {
    const Vector3d direction = term.weight * vector(term.axis).normalized();
    (term.rotation ? torque : force) += direction;
    for (ForceAlong &part : shared(name, term.marker, direction, term.rotation))
      all.push_back(std::move(part));
  }
  const auto on_ground = [&](const Vector3d &rest, bool turns)
  {
    if (rest.norm() < negligible)
      return;
    all.push_back(along(name, "ground", -rest, turns));
    all.back().at = placed(model_, {"ground", point_of(model_, {motion.front().marker, std::nullopt})});
  };
  on_ground(force, false);
  if (turns_alone)
    on_ground(torque, true);
  return all;
}

void Places::add_motion(const std::string &name, const MotionMeasure &motion, int measure, bool turns_alone)
{
  for (ForceAlong &part : all_along(name, motion, turns_alone))
  {
    part.measure = measure;
    places_.along.push_back(std::move(part));
  }
}

void Places::add_signal(const std::string &name, const MotionMeasure &motion, double sign)
{
  for (ForceAlong &part : all_along(name, motion, turns(motion)))
  {
    part.signal = machine_.signal(name, name + ".force");
    part.sign   = sign;
    places_.along.push_back(std::move(part));
  }
}

void Places::add_between(const std::string &name, const PlaceRequest &from, const PlaceRequest &to,
                         const coupling::ElementPlacement &element, int begin, int end, bool is_load)
{
  ForceBetween force;
  force.name          = name;
  force.first_measure = next_ + begin;
  force.measures.assign(element.measures.begin() + begin, element.measures.begin() + end);
  force.first      = {from.marker, placed(model_, from), {}};
  force.second     = {to.marker, placed(model_, to), {}};
  force.is_load    = is_load;
  const auto first = moved_by(force.first.at), second = moved_by(force.second.at);
  force.first.own  = without(first, second);
  force.second.own = is_load ? without(second, {}) : without(second, first);
  places_.between.push_back(std::move(force));
}

} // namespace

ForcePlaces force_places(const Scene &scene, const coupling::Machine &machine)
{
  return Places(scene, machine).all();
}

} // namespace gestell::apps

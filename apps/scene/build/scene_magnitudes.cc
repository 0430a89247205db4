#include "apps/scene/build/scene_magnitudes.h"

#include "apps/scene/build/build_measures.h"
#include "apps/scene/file/override_rules.h"
#include "coupling/simulation/checks/element_scales.h"
#include "fem/values/number_text.h"
#include "mechanism/elements/connecting_rod.h"
#include "mechanism/elements/dynamic_motor.h"
#include "mechanism/elements/journal_bearing.h"
#include "mechanism/elements/point_contact.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

using mechanism::Clearance;
using mechanism::ConnectingRod;
using mechanism::JournalBearing;
using mechanism::KlossMotor;
using mechanism::PointContact;

using Warnings = std::vector<UnexpectedValue>;

std::string size_text(double metres)
{
  const DisplayUnit unit = display_unit("m", std::abs(metres));
  return short_text(unit.factor * metres, 3) + " " + unit.unit;
}

/// The law of a request, if it is of that kind.
template <typename Law>
const Law *law_of(const ElementRequest &element)
{
  return dynamic_cast<const Law *>(element.element.get());
}

void judge_play(const Scene &scene, const ElementRequest &element, const std::string &key, double play, double most,
                double size, const std::string &of_what, Warnings &warnings)
{
  if (size > 0. && std::abs(play) > most * size)
    warnings.push_back({key_place(scene, element.name, key),
                        "is " + size_text(play) + "; expected: at most " + size_text(most * size) + ", " +
                            short_text(most) + " of " + of_what + " (" + size_text(size) +
                            ") (more is not a clearance); check the unit",
                        std::abs(play) / (most * size)});
}

void judge_plays(const Scene &scene, double size, Warnings &warnings)
{
  constexpr double most_play_of_crank = 0.03; // of the crank radius: worn pins have some 0.01
  constexpr double most_play          = 0.1;  // of the machine: more is a way to travel, not a play
  for (const ElementRequest &element : scene.elements)
    if (element.kind == coupling::MeasureKind::angle)
      continue;
    else if (const auto *rod = law_of<ConnectingRod>(element))
      judge_play(scene, element, "clearance", rod->parameters().clearance, most_play_of_crank,
                 rod->parameters().crank_radius, "the crank radius", warnings);
    else if (const auto *journal = law_of<JournalBearing>(element))
    {
      const bool       pin              = journal->parameters().radius > 0.;
      constexpr double most_play_of_pin = 0.2; // of its radius: bearings have 0.001, worn ones some 0.05
      judge_play(scene, element, "clearance", journal->parameters().clearance, pin ? most_play_of_pin : most_play,
                 pin ? journal->parameters().radius : size, pin ? "the journal's radius" : "the machine's size",
                 warnings);
    }
    else
    {
      const auto      *point         = law_of<PointContact>(element);
      const auto      *contact       = point ? &point->normal() : law_of<Clearance>(element);
      constexpr double farthest_stop = 1.; // of the machine: what is farther is out of reach
      if (contact)
        judge_play(scene, element, "gap", contact->parameters().gap,
                   contact->parameters().stops == Clearance::Stops::both ? most_play : farthest_stop, size,
                   "the machine's size", warnings);
    }
}

/// Between the points at which joints and measures act on a body.
double extent_of(const coupling::Body &body)
{
  Eigen::AlignedBox3d box(vector(body.centre));
  for (const Vector3 &point : body.points)
    box.extend(vector(point));
  return std::max({box.diagonal().norm(), 2. * body.radius, vector(body.size).norm()});
}

void judge_bodies(const Scene &scene, const coupling::MachineModel &machine, double size, Warnings &warnings)
{
  for (const BodyRequest &body : scene.bodies)
  {
    const double arm      = body.mass > 0. && body.inertia > 0. ? std::sqrt(body.inertia / body.mass) : 0.;
    const bool   reported = arm < 1e-4 || arm > 20.; // warn_of_implausible_numbers() has one then
    if (!reported && body.kind == coupling::BodyKind::planar)
    {
      const double own = extent_of(machine.body(body.name));
      // of a body's extent, of the machine; a rod has 0.29
      constexpr double least_gyration = 0.01, most_gyration = 1.;
      const double     excess = std::max(least_gyration * own / arm, size > 0. ? arm / (most_gyration * size) : 0.);
      if (excess > 1.)
        warnings.push_back({place_of_key(body.place, "inertia"),
                            "with its mass gives a radius of gyration of " + size_text(arm) + "; expected: " +
                                size_text(least_gyration * own) + " to " + size_text(most_gyration * size) +
                                " for the points of the body and the size of the machine; check the units of both",
                            excess});
    }
    if (body.unbalance && body.radius > 0. && body.unbalance->amount * body.radius > body.inertia)
      warnings.push_back({place_of_key(body.place, "unbalance"),
                          "is " + short_text(body.unbalance->amount) + " kg m; expected: at most " +
                              short_text(body.inertia / body.radius) +
                              " kg m, with which a mass at the rim alone has the inertia of the rotor; check the unit",
                          body.unbalance->amount * body.radius / body.inertia});
  }
}

/// Springs of the base system are only in the scene.
std::vector<coupling::ElementScale> all_scales(const Scene &scene, const coupling::Machine &machine)
{
  auto scales = coupling::element_scales(machine, Eigen::VectorXd::Zero(machine.size()));
  for (const LinearRequest &spring : scene.linear)
    if (spring.stiffness > 0.)
      scales.push_back({spring.name, spring.stiffness, spring.damping,
                        coupling::mass_on(machine, measure_of(spring.u, machine.model()))});
  return scales;
}

void judge_elements(const Scene &scene, const coupling::Machine &machine, Warnings &warnings)
{
  for (const coupling::ElementScale &scale : all_scales(scene, machine))
  {
    constexpr double highest_hz = 50e3; // structure-borne sound of machines ends at some 20 kHz
    if (scale.frequency_hz() > highest_hz)
      warnings.push_back(
          {key_place(scene, scale.name, "stiffness"),
           "gives, with the masses it acts on, a frequency of " + short_text(scale.frequency_hz()) +
               " Hz; expected: at most " + short_text(highest_hz) +
               " Hz, since parts of machines vibrate below 20 kHz; check the units of stiffness and masses",
           scale.frequency_hz() / highest_hz});
    constexpr double most_damped = 10.; // spring-dampers have ratios up to 1; with 10 nothing swings
    if (scale.ratio() > most_damped)
      warnings.push_back(
          {key_place(scene, scale.name, "damping"),
           "with the stiffness and the masses gives a damping ratio of " + short_text(scale.ratio()) +
               "; expected: at most " + short_text(most_damped) +
               " (springs and dampers of machines: 0.001 to 1); check the units of stiffness, damping and masses",
           scale.ratio() / most_damped});
  }
}

/// Springs of the base system: what preload and weight do to the masses that they act on.
void judge_springs(const Scene &scene, const coupling::Machine &machine, double size, Warnings &warnings)
{
  const Eigen::Vector3d g = vector(scene.gravity);
  for (const LinearRequest &spring : scene.linear)
  {
    if (spring.u.empty())
      continue;
    const MotionTerm &motion = spring.u.front();
    const double      mass   = coupling::mass_on(machine, measure_of(spring.u, machine.model()));
    if (motion.rotation || !(mass > 0.))
      continue;
    constexpr double hardest_push = 1e4; // [m/s^2] valve springs accelerate their valves by up to 5000
    if (const double push = std::abs(spring.preload) / mass; push > hardest_push)
      warnings.push_back({key_place(scene, spring.name, "preload"),
                          "accelerates the " + short_text(mass) + " kg that it acts on by " + short_text(push) +
                              " m/s^2; expected: at most " + short_text(hardest_push) +
                              " m/s^2, twice that of valve springs; check the units of preload and mass",
                          push / hardest_push});
    const double weight = mass * std::abs(g.dot(vector(motion.axis)));
    if (const double sag = spring.stiffness > 0. && spring.preload == 0. ? weight / spring.stiffness : 0.;
        size > 0. && sag > most_yielding * size)
      warnings.push_back({key_place(scene, spring.name, "stiffness"),
                          "deflects by " + size_text(sag) + " under the weight of " + short_text(mass) +
                              " kg; expected: " + yielding_text(size) + "; check the units of stiffness and mass",
                          sag / (most_yielding * size)});
  }
}

const KlossMotor *motor_of(const ElementRequest &element)
{
  const auto *dynamic = law_of<mechanism::DynamicMotor>(element);
  return dynamic ? &dynamic->stationary() : law_of<KlossMotor>(element);
}

/// Start-up time from rest to the synchronous speed with the breakdown torque: J Omega / (i^2 M_K).  With joints the
/// motor may drive more inertia than its shaft; then no time counts as too short.
void judge_motors(const Scene &scene, const coupling::Machine &machine, Warnings &warnings)
{
  for (const coupling::ElementPlacement &placement : machine.model().elements())
    for (const ElementRequest &element : scene.elements)
      if (const KlossMotor *motor = element.name == placement.name ? motor_of(element) : nullptr)
      {
        const auto  &own  = motor->parameters();
        const double J    = coupling::mass_on(machine, placement.measures.front());
        const double time = J * std::abs(own.synchronous_speed) / (own.ratio * own.ratio * own.breakdown_torque);
        // [s] bare servo motors take some 10 ms, centrifuges some minutes
        constexpr double quickest = 5e-3, slowest = 1000.;
        if (J > 0. && ((time < quickest && !coupling::has_joints(machine)) || time > slowest))
          warnings.push_back(
              {key_place(scene, element.name, "breakdown_torque"),
               "with ratio " + short_text(own.ratio) + " accelerates the " + short_text(J) +
                   " kg m^2 of its shaft to the synchronous speed within " + short_text(time) +
                   " s; expected: " + short_text(quickest) + " s to " + short_text(slowest) +
                   " s, since motors alone need 10 ms and centrifuges minutes; check torque, ratio, inertia",
               std::max(quickest / time, time / slowest)});
      }
}

/// g / omega^2 of the lowest elastic mode of the supported frame.  Prestress softens it as near to nothing as its
/// buckling factor is to one.
void judge_frame(const Scene &scene, const coupling::MachineModel &machine, double size, Warnings &warnings)
{
  const coupling::ReducedFrame *frame = machine.reduced_frame();
  const double                  g     = vector(scene.gravity).norm();
  if (!frame || !(size > 0.) || scene.frame.geometry.prestress)
    return;
  for (const double hz : frame->frequencies_hz)
    if (hz > 0.)
    {
      const double weight = g > 0. ? g : 9.81, sag = weight / std::pow(2. * M_PI * hz, 2);
      if (sag > most_yielding * size)
        warnings.push_back({scene.frame.place,
                            "the lowest frequency of the frame on its supports is " + short_text(hz) +
                                " Hz: its weight deflects it in this mode by " + size_text(sag) +
                                "; expected: " + yielding_text(size) + "; check stiffness, supports and masses",
                            sag / (most_yielding * size)});
      return;
    }
}

} // namespace

double machine_size(const Scene &scene, const coupling::MachineModel &machine)
{
  Eigen::AlignedBox3d box;
  const auto          extend = [&](const Vector3 &centre, double radius)
  {
    const Eigen::Vector3d about = Eigen::Vector3d::Constant(radius);
    box.extend(vector(centre) - about);
    box.extend(vector(centre) + about);
  };
  double rods = 0.;
  for (const coupling::Body &body : machine.bodies())
  {
    extend(body.position, std::max(body.radius, 0.5 * vector(body.size).norm()));
    for (const Vector3 &point : body.points)
      extend(point, 0.);
  }
  for (const NamedPlace &place : scene.places)
    if (place.point.at)
      extend(*place.point.at, 0.);
  for (const JointRequest &joint : scene.joints)
    for (const PlaceRequest *place : {&joint.from, &joint.to})
      if (place->at)
        extend(*place->at, 0.);
  const coupling::ReducedFrame *reduced = machine.reduced_frame();
  const fem::FrameMatrices     *full    = machine.full_frame();
  if (reduced || full)
    for (const fem::Interface &interface : reduced ? reduced->interfaces : full->interfaces)
      extend(interface.position, 0.);
  for (const coupling::DrawnRod &rod : scene.rods)
    rods = std::max(rods, rod.crank_radius + rod.length);
  return std::max(box.isEmpty() ? 0. : box.diagonal().norm(), rods);
}

std::string key_place(const Scene &scene, const std::string &object, const std::string &key)
{
  const auto place = scene.element_places.find(object);
  return place_of_key(place == scene.element_places.end() ? object : place->second, key);
}

std::string yielding_text(double size)
{
  return "at most " + size_text(most_yielding * size) + ", " + short_text(most_yielding) +
         " of the size of the machine, the range of vehicle suspensions and air springs";
}

std::vector<UnexpectedValue> scene_magnitudes(const Scene &scene, const coupling::Machine &machine, Masses masses)
{
  Warnings     warnings;
  const double size = machine_size(scene, machine.model());
  judge_plays(scene, size, warnings);
  judge_bodies(scene, machine.model(), size, warnings);
  if (masses == Masses::of_stand_in)
    return warnings;
  judge_elements(scene, machine, warnings);
  judge_springs(scene, machine, size, warnings);
  judge_motors(scene, machine, warnings);
  judge_frame(scene, machine.model(), size, warnings);
  return warnings;
}

std::vector<UnexpectedValue> magnitudes_of_modes(const Scene &scene, const std::vector<coupling::Mode> &of_frame)
{
  Warnings         warnings;
  constexpr double most_frame_damping = 0.7; // with 1 a frame does not vibrate
  for (const coupling::Mode &mode : of_frame)
    if (mode.frequency_hz > 0. && !(mode.damping_ratio < most_frame_damping)) // nan: it does not vibrate
    {
      const bool   creeps = std::isnan(mode.damping_ratio);
      const double ratio  = creeps ? 1. : mode.damping_ratio; // or more
      warnings.push_back(
          {place_of_key(scene.frame.place, "damping"),
           "damps the mode of the frame at " + short_text(mode.frequency_hz) + " Hz by a ratio of " +
               short_text(ratio) + (creeps ? " or more" : "") + "; expected: at most " +
               short_text(most_frame_damping) +
               ", since foundations on viscous dampers have 0.3; check the units of damping and stiffness",
           ratio / most_frame_damping});
      break;
    }
  return warnings;
}

} // namespace gestell::apps

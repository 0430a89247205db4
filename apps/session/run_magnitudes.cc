#include "apps/session/run_magnitudes.h"

#include "apps/scene/build/scene_magnitudes.h"
#include "coupling/machine/element_law.h"
#include "coupling/simulation/checks/element_scales.h"
#include "fem/values/number_text.h"
#include "mechanism/elements/cubic_spring.h"
#include "mechanism/elements/dynamic_motor.h"
#include "mechanism/elements/formula_force.h"
#include "mechanism/elements/hydraulic_cylinder.h"
#include "mechanism/elements/spring_damper.h"
#include "mechanism/elements/table_force.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

constexpr double most_twist = 0.5;       ///< [rad] of a clutch, shaft or contact: highly elastic couplings allow 0.3
constexpr double most_turns = 4. * M_PI; ///< [rad] of a torsion spring to the ground: two revolutions

using coupling::ElementPlacement;
using mechanism::KlossMotor;

/// The quantity that is its force or torque; empty: it has none of one number.
std::string force_of(const ElementPlacement &placement)
{
  for (const mechanism::Quantity &quantity : placement.element->quantities())
    for (const char *name : {"force", "normal_force", "torque", "resultant"})
      if (quantity.name == name)
        return name;
  return "";
}

/// Breakdown slip of an asynchronous motor; 0: it is none.
double breakdown_slip(const ElementPlacement &placement)
{
  const auto *dynamic = coupling::law_of<mechanism::DynamicMotor>(placement);
  const auto *motor   = dynamic ? &dynamic->stationary() : coupling::law_of<KlossMotor>(placement);
  return motor ? motor->parameters().breakdown_slip : 0.;
}

/// A general characteristic may have any meaning.
bool is_characteristic(const ElementPlacement &placement)
{
  return coupling::law_of<mechanism::FormulaForce>(placement) || coupling::law_of<mechanism::TableForce>(placement) ||
         coupling::law_of<mechanism::HydraulicCylinder>(placement);
}

bool is_spring(const ElementPlacement &placement)
{
  return coupling::law_of<mechanism::SpringDamper>(placement) || coupling::law_of<mechanism::CubicSpring>(placement);
}

std::string amount(double value, const std::string &si_unit)
{
  const DisplayUnit unit = display_unit(si_unit, std::abs(value));
  return short_text(unit.factor * value, 3) + " " + unit.unit;
}

std::string at(double t)
{
  return " at " + short_text(t) + " s";
}

} // namespace

RunMagnitudes::RunMagnitudes(const Scene &scene, const coupling::Machine &machine, const coupling::Machine &small)
    : scene_(scene), machine_(machine.model()), size_(machine_size(scene, small.model()))
{
  watch_elements(small);
  watch_springs();
  watch_bodies();
  watch_frame(small.model());
  for (coupling::Signal &signal : signals_.signals)
    signal = machine.signal(signal.name, signal.name);
}

/// The index of the signal is found when all signals are known.
void RunMagnitudes::watch(Kind kind, const std::string &object, const std::string &path, double scale)
{
  watched_.push_back({kind, object, scale});
  signals_.signals.emplace_back();
  signals_.signals.back().name = object + "." + path;
}

void RunMagnitudes::watch_elements(const coupling::Machine &small)
{
  const auto scales = coupling::element_scales(small, Eigen::VectorXd::Zero(small.size()));
  for (const ElementPlacement &placement : small.model().elements())
  {
    if (!placement.element->force_law() || placement.joint >= 0)
      continue;
    const std::string force = force_of(placement);
    const auto        scale = std::find_if(scales.begin(), scales.end(),
                                           [&](const coupling::ElementScale &one) { return one.name == placement.name; });
    if (const double slip = breakdown_slip(placement); slip > 0. && !commanded(placement.name))
      watch(Kind::slip, placement.name, "slip", slip);
    else if (is_spring(placement))
      watch(Kind::travel, placement.name, "displacement", most_turns);
    else if (!force.empty() && scale != scales.end() && !is_characteristic(placement))
      watch(Kind::deformation, placement.name, force, scale->stiffness);
    if (!force.empty() && placement.element->branches() && !commanded(placement.name))
      watch(Kind::contact, placement.name, force);
  }
}

void RunMagnitudes::watch_springs()
{
  for (const LinearRequest &spring : scene_.linear)
    if (spring.stiffness > 0.)
      watch(Kind::travel, spring.name, "displacement", spring.u.size() > 1 ? most_twist : most_turns);
}

void RunMagnitudes::watch_bodies()
{
  for (const coupling::Body &body : machine_.bodies())
    if (body.kind == coupling::BodyKind::rotor)
      watch(Kind::turning, body.name, "speed", body.radius);
    else if (body.kind == coupling::BodyKind::slider)
    {
      watch(Kind::speed, body.name, "velocity");
      watch(Kind::way, body.name, "displacement");
    }
    else
      for (int d = 0; d < 3; ++d)
        if (!body.marker.translation[d].empty())
        {
          watch(Kind::speed, body.name, std::string("v") + "xyz"[d]);
          watch(Kind::way, body.name, std::string("u") + "xyz"[d]);
        }
}

/// A frame that its supports leave free moves as a body.
void RunMagnitudes::watch_frame(const coupling::MachineModel &small)
{
  constexpr const char         *motions[] = {"ux", "uy", "uz"};
  const coupling::ReducedFrame *frame     = small.reduced_frame();
  if (!frame || frame->n_rigid() > 0)
    return;
  for (const fem::Interface &interface : frame->interfaces)
    for (int d = 0; d < 3; ++d)
      if (interface.coordinate[std::size_t(d)] >= 0)
        watch(Kind::yielding, "frame." + interface.name, motions[d]);
}

/// Length of an element: for a rod its own, for others the size of the machine.
double RunMagnitudes::size_of(const std::string &element) const
{
  for (const coupling::DrawnRod &rod : scene_.rods)
    if (rod.name == element)
      return rod.crank_radius + rod.length;
  return size_;
}

bool RunMagnitudes::commanded(const std::string &element) const
{
  for (const coupling::Switch &one : machine_.switches())
    for (const coupling::SwitchOrder &order : one.orders)
      if (order.element == element)
        return true;
  return false;
}

std::optional<UnexpectedValue> RunMagnitudes::judged_slip(const Watched                &watched,
                                                          const coupling::WatchedValue &value) const
{
  const double most       = watched.scale;
  const auto   unexpected = [&](const char *when, double slip, const char *expected)
  {
    return UnexpectedValue{key_place(scene_, watched.object, "slip"),
                           std::string(when) + " of the run is " + short_text(slip) + "; expected: " + expected +
                               "within the breakdown slip of " + short_text(most) +
                               "; check synchronous_speed, ratio, breakdown_torque and the initial speeds",
                           std::abs(slip) / most};
  };
  constexpr double standstill = 0.05; // of the synchronous speed: a motor that starts
  const bool       turns      = std::abs(1. - value.first) > standstill;
  if (turns && std::abs(value.first) > most)
    return unexpected("at the start", value.first, "1 at standstill, or ");
  // A start-up that is still in progress is not a mistake.
  const bool starting_up = value.last < value.first - standstill && value.last > -most;
  if (std::abs(value.last) > most && !starting_up)
    return unexpected("at the end", value.last, "");
  return std::nullopt;
}

bool RunMagnitudes::acted(const Watched &watched, const coupling::WatchedValue &value,
                          const coupling::RunResult &run) const
{
  return value.largest() > 0. ||
         std::any_of(run.events.begin(), run.events.end(),
                     [&](const coupling::Event &event) { return event.name == watched.object; });
}

std::optional<UnexpectedValue> RunMagnitudes::judged(const Watched &watched, const std::string &unit,
                                                     const coupling::WatchedValue &value,
                                                     const coupling::RunResult    &run) const
{
  const auto above = [](double amount, double most, const std::string &place, const std::string &words) {
    return most > 0. && amount > most ? std::optional(UnexpectedValue{place, words, amount / most}) : std::nullopt;
  };
  const auto        key      = [&](const char *name) { return key_place(scene_, watched.object, name); };
  const std::string body     = "body." + watched.object;
  const double      way      = value.most - value.least;
  constexpr double  farthest = 10.;  // of the machine: beyond, a body has left it
  constexpr double  fastest  = 300.; // [m/s] of a body: tools and slides move below the speed of sound in air
  switch (watched.kind)
  {
  case Kind::deformation:
  {
    const bool       turns   = unit == "N m";
    constexpr double softest = 0.05; // [m] tyres and rubber mounts of any machine yield by centimetres
    const double     size = size_of(watched.object), e = value.largest() / watched.scale,
                 most = turns       ? most_twist
                        : size > 0. ? std::max(softest, most_yielding * size)
                                    : 0.;
    return above(
        e, most, key("stiffness"),
        "deflects by " + amount(e, turns ? "rad" : "m") + " under its largest force of " +
            amount(value.largest(), unit) + at(value.t_largest()) + "; expected: at most " +
            amount(most, turns ? "rad" : "m") +
            (turns ? ", the range of highly elastic couplings"
                   : ", or " + short_text(most_yielding) + " of the length of the rod or the size of the machine") +
            "; check the units of its stiffness and of masses and loads");
  }
  case Kind::travel:
  {
    const bool       turns       = unit == "rad";
    constexpr double most_travel = 1.; // of the machine: no spring is longer
    const double     most        = turns ? watched.scale : most_travel * size_;
    return above(way, most, key("stiffness"),
                 "the relative displacement of its ends is " + amount(way, unit) + "; expected: at most " +
                     amount(most, unit) +
                     (turns ? ", the range of elastic couplings and torsion springs" : ", the size of the machine") +
                     "; check the units of its stiffness and of masses and loads");
  }
  case Kind::contact:
  {
    if (acted(watched, value, run) || !run.failure.empty() || run.interrupted)
      return std::nullopt;
    const auto own = scene_.element_places.find(watched.object);
    return UnexpectedValue{own == scene_.element_places.end() ? watched.object : own->second,
                           "never acts in this run (its force stays zero); expected: a force at some time; check its "
                           "location, its gap and the motion, or remove it",
                           1.};
  }
  case Kind::slip:
    return judged_slip(watched, value);
  case Kind::turning:
  {
    const double rim = value.largest() * watched.scale;
    // [m/s] of a solid disc of steel at sqrt(8 sigma / ((3 + nu) rho)) with a strength of 600 MPa
    constexpr double fastest_rim = 430.;
    return above(rim, fastest_rim, body + ".radius",
                 "the speed of its rim is " + amount(rim, "m/s") + at(value.t_largest()) + "; expected: at most " +
                     amount(fastest_rim, "m/s") +
                     ", at which a disc of steel bursts; check speeds, torques and inertia");
  }
  case Kind::speed:
    return above(value.largest(), fastest, body,
                 "moves with " + amount(value.largest(), "m/s") + at(value.t_largest()) + "; expected: at most " +
                     amount(fastest, "m/s") + ", the range of tools and slides; check forces, mass and speeds");
  case Kind::yielding:
    return above(way, most_yielding * size_, scene_.frame.place,
                 "the frame deflects at \"" + watched.object + "\" by " + amount(way, "m") +
                     "; expected: " + yielding_text(size_) + "; check stiffness, supports and loads");
  case Kind::way:
    return above(way, farthest * size_, body,
                 "moves " + amount(way, "m") + "; expected: at most " + amount(farthest * size_, "m") + ", " +
                     short_text(farthest) +
                     " times the size of the machine; check its supports, its mass and its loads");
  }
  return std::nullopt;
}

std::vector<UnexpectedValue> RunMagnitudes::unexpected(const coupling::RunResult &run) const
{
  std::vector<UnexpectedValue> values;
  for (std::size_t i = 0; i < signals_.values.size(); ++i)
    if (signals_.values[i].known)
      if (auto value = judged(watched_[i], signals_.signals[i].unit, signals_.values[i], run))
        values.push_back(std::move(*value));
  return values;
}

} // namespace gestell::apps

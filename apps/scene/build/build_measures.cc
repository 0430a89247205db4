#include "apps/scene/build/build_measures.h"

#include "apps/scene/build/tangent_measures.h"
#include "fem/values/number_text.h"
#include "mechanism/elements/follower_load.h"
#include "mechanism/joints/measure_joint.h"
#include "mechanism/transmitted_element.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

using mechanism::CombinedMeasure;
using mechanism::PlacedMeasure;

/// A measure and the motions of the machine it depends on.
template <class Measure>
struct Built
{
  Measure                        measure;
  std::vector<coupling::Measure> measures;
};

/// Gear mesh of wheels in the reference configuration: the radii follow from the distance of the centres.
mechanism::RelativeMeasure mesh_of(const MeshRequest &request, const mechanism::Placement &first,
                                   const mechanism::Placement &second)
{
  const double angle = std::abs(request.pressure_angle), to = centre_distance(first, second, vector(request.axis)) /
                                                              std::abs(1. - request.ratio) * std::cos(angle);
  // Teeth push: apart the wheels, or the wheel out of its ring.
  const bool apart = (request.ratio < 0.) == (request.pressure_angle > 0.);
  return tangent_of(first, second, vector(request.axis), {-request.ratio * to, to},
                    angle > 0. ? (apart ? 1. : -1.) : 0., mechanism::RelativeMeasure::Form::gear);
}

std::string triple(const Vector3 &a)
{
  return "[" + rounded(a[0]) + ", " + rounded(a[1]) + ", " + rounded(a[2]) + "]";
}

/// "; it has ux, uy, uz", and the alternative for rotations of a single node.
std::string motions_left(const coupling::Marker &marker, bool rotation)
{
  std::string has;
  for (int i = 0; i < 6; ++i)
    if (!(i < 3 ? marker.translation[i] : marker.rotation[i - 3]).empty())
      has += std::string(has.empty() ? "" : ", ") + (i < 3 ? "u" : "r") + "xyz"[i % 3];
  const bool is_interface = marker.name.rfind("frame.", 0) == 0;
  return (is_interface ? "; its DOFs on the frame: " + (has.empty() ? "none" : has) : "") + "; name another DOF" +
         (is_interface && rotation ? ", or an interface with rotations (on a surface, not on a single node)" : "");
}

std::invalid_argument no_motion(const MotionTerm &term, const coupling::MachineModel &machine)
{
  return std::invalid_argument("acts on a DOF that does not exist: \"" + term.marker + "\" does not " +
                               (term.rotation ? "rotate about " : "move along ") + triple(term.axis) +
                               ", nor does the other body" + motions_left(machine.marker(term.marker), term.rotation));
}

/// Whether the motion of a point is linear, so that a zero gradient remains zero.
bool is_linear(const mechanism::Placement &place)
{
  return place.n_measures() == 0 || (!place.turns() && place.is_linear(place.n_measures() - 1));
}

void require_motion(const MeasureRequest &request, const Built<PlacedMeasure> &built)
{
  bool moves = std::any_of(built.measures.begin(), built.measures.end(), [](const auto &u) { return !u.empty(); });
  if (request.form == mechanism::RelativeMeasure::Form::along && is_linear(built.measure.first) &&
      is_linear(built.measure.second))
  {
    const double zero[CombinedMeasure::max_measures] = {};
    double       gradient[CombinedMeasure::max_measures];
    CombinedMeasure(built.measure).evaluate(zero, zero, gradient);
    moves = std::any_of(gradient, gradient + built.measures.size(), [](double slope) { return slope != 0.; });
  }
  if (!moves)
    throw std::invalid_argument(
        "neither \"" + request.first.marker + "\" nor \"" + request.second.marker +
        "\" moves in this direction, so the measure is always zero; name other points or another direction");
}

Built<PlacedMeasure> build_placed(coupling::MachineModel &machine, const MeasureRequest &request)
{
  const auto                 first = placed(machine, request.first), second = placed(machine, request.second);
  mechanism::RelativeMeasure measure;
  measure.form    = request.form;
  measure.a       = vector(request.a);
  measure.b       = vector(request.b);
  measure.carrier = request.carrier;
  if (request.mesh)
    measure = mesh_of(*request.mesh, first.placement, second.placement);
  auto measures = first.measures;
  measures.insert(measures.end(), second.measures.begin(), second.measures.end());
  draw_places(machine, request.first, request.second);
  const Built<PlacedMeasure> built{{first.placement, second.placement, measure}, measures};
  require_motion(request, built);
  return built;
}

Built<PlacedMeasure> build_term(coupling::MachineModel &machine, const TermRequest &term)
{
  if (term.placed)
    return build_placed(machine, *term.placed);
  const auto u = measure_of(term.motion, machine);
  if (u.empty())
    throw no_motion(term.motion.front(), machine);
  return {PlacedMeasure::linear(), {u}};
}

Built<CombinedMeasure> build(coupling::MachineModel &machine, const MeasureRequest &request)
{
  if (request.terms.empty())
  {
    const auto plain = build_placed(machine, request);
    return {CombinedMeasure(plain.measure), plain.measures};
  }
  std::vector<CombinedMeasure::Term> terms;
  std::vector<coupling::Measure>     measures;
  const auto                         take = [&](const TermRequest &request)
  {
    auto term = build_term(machine, request);
    measures.insert(measures.end(), term.measures.begin(), term.measures.end());
    return term.measure;
  };
  for (const TermRequest &term : request.terms)
    terms.push_back({term.weight, take(term)});
  if (!request.function)
    return {CombinedMeasure(terms), measures};
  const PlacedMeasure x = take(request.argument);
  return {CombinedMeasure(terms, x, request.function), measures};
}

/// Value of the measure in the reference configuration.
double described_value(const CombinedMeasure &measure)
{
  const double zero[CombinedMeasure::max_measures] = {};
  double       gradient[CombinedMeasure::max_measures];
  return measure.evaluate(zero, zero, gradient).s;
}

} // namespace

coupling::Measure measure_of(const MotionMeasure &motion, const coupling::MachineModel &machine)
{
  using coupling::operator+, coupling::operator*; // a Measure is a plain vector, so the namespace does not tell
  coupling::Measure u;
  for (const auto &term : motion)
  {
    const auto &marker = machine.marker(term.marker);
    u                  = u + term.weight * (term.rotation ? marker.about(term.axis) : marker.along(term.axis));
  }
  return u;
}

std::vector<coupling::Measure> measures_of(const std::vector<MotionMeasure> &motions,
                                           const coupling::MachineModel     &machine)
{
  std::vector<coupling::Measure> measures;
  for (const MotionMeasure &motion : motions)
    measures.push_back(measure_of(motion, machine));
  const bool idle = std::all_of(measures.begin(), measures.end(), [](const auto &u) { return u.empty(); });
  if (idle && !motions.empty() && !motions.front().empty())
    throw no_motion(motions.front().front(), machine);
  return measures;
}

void draw_places(coupling::MachineModel &machine, const PlaceRequest &from, const PlaceRequest &to)
{
  for (const PlaceRequest *place : {&from, &to})
    machine.draw_point(place->marker, point_of(machine, *place));
}

void add_measures(coupling::MachineModel &machine, const Scene &scene)
{
  for (const MeasureRequest &request : scene.measures)
  {
    try
    {
      const auto built = build(machine, request);
      machine.add_measure({request.name, request.unit, built.measure, built.measures});
    }
    catch (const std::invalid_argument &e)
    {
      throw std::invalid_argument(request.place + ": " + e.what());
    }
  }
}

void add_measure_joint(coupling::MachineModel &machine, const JointRequest &joint)
{
  const bool turns = joint.measure.unit == "rad";
  const auto built = build(machine, joint.measure);
  machine.attach(
      joint.name,
      std::make_shared<mechanism::MeasureJoint>(
          mechanism::MeasureJoint::Parameters{built.measure, joint.value.value_or(described_value(built.measure)),
                                              turns ? "torque" : "force", turns ? "N m" : "N", joint.reaction_unit},
          joint.law),
      built.measures);
}

void attach_on_measure(coupling::MachineModel &machine, const ElementRequest &element)
{
  const auto attach = [&](const CombinedMeasure &measure, std::vector<coupling::Measure> measures, double rest)
  {
    for (const LagRequest &lag : element.lags)
      measures.push_back({{machine.add_lag(lag.name, lag.time_constant), 1.}});
    machine.attach(element.name, std::make_shared<mechanism::TransmittedElement>(measure, element.element, rest),
                   measures, element.kind);
  };
  if (element.follows)
  {
    const auto point = placed(machine, element.own->second);
    machine.attach(element.name,
                   std::make_shared<mechanism::FollowerLoad>(point.placement, vector(element.own->a), element.element),
                   point.measures, element.kind);
    machine.draw_point(element.own->second.marker, point_of(machine, element.own->second));
    return;
  }
  if (element.own)
  {
    const auto built = build(machine, *element.own);
    attach(built.measure, built.measures, described_value(built.measure));
    return;
  }
  const coupling::NamedMeasure &measure = machine.measure(element.on);
  attach(measure.measure, measure.measures, 0.);
  const PlacedMeasure *plain = measure.measure.plain();
  if (!plain || plain->measure.form != mechanism::RelativeMeasure::Form::distance)
    return;
  // A spring or a rope between two places is drawn as a distance joint is.
  const auto second = measure.measures.begin() + plain->first.n_measures();
  machine.draw_bar({element.name,
                    {plain->first, {measure.measures.begin(), second}},
                    {plain->second, {second, measure.measures.end()}}});
}

} // namespace gestell::apps

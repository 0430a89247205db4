#include "apps/scene/build_measures.h"

#include "mechanism/joints/measure_joint.h"
#include "mechanism/transmitted_element.h"

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

Built<PlacedMeasure> build_placed(coupling::Machine &machine, const MeasureRequest &request)
{
  const auto                 first = placed(machine, request.first), second = placed(machine, request.second);
  mechanism::RelativeMeasure measure;
  measure.form    = request.form;
  measure.a       = vector(request.a);
  measure.b       = vector(request.b);
  measure.carrier = request.carrier;
  auto measures   = first.measures;
  measures.insert(measures.end(), second.measures.begin(), second.measures.end());
  draw_places(machine, request.first, request.second);
  return {{first.placement, second.placement, measure}, measures};
}

Built<PlacedMeasure> build_term(coupling::Machine &machine, const TermRequest &term)
{
  if (term.placed)
    return build_placed(machine, *term.placed);
  const auto u = measure_of(term.motion, machine);
  if (u.empty())
  {
    const MotionTerm &motion = term.motion.front();
    throw std::invalid_argument("\"" + motion.marker + "\" does not " +
                                (motion.rotation ? "turn about" : "move along") +
                                " the axis that is asked for, nor does its partner; name another motion");
  }
  return {PlacedMeasure::linear(), {u}};
}

Built<CombinedMeasure> build(coupling::Machine &machine, const MeasureRequest &request)
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

} // namespace

coupling::Measure measure_of(const MotionMeasure &motion, const coupling::Machine &machine)
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

Vector3 point_of(const coupling::Machine &machine, const PlaceRequest &place)
{
  return place.at ? *place.at : machine.position(place.marker);
}

coupling::PlacedPoint placed(const coupling::Machine &machine, const PlaceRequest &place)
{
  return machine.place(place.marker, point_of(machine, place));
}

void draw_places(coupling::Machine &machine, const PlaceRequest &from, const PlaceRequest &to)
{
  for (const PlaceRequest *place : {&from, &to})
    machine.draw_point(place->marker, point_of(machine, *place));
}

void add_measures(coupling::Machine &machine, const Scene &scene)
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

void add_measure_joint(coupling::Machine &machine, const JointRequest &joint)
{
  const bool   turns                               = joint.measure.unit == "rad";
  const auto   built                               = build(machine, joint.measure);
  const double zero[CombinedMeasure::max_measures] = {};
  double       gradient[CombinedMeasure::max_measures];
  const double described = built.measure.evaluate(zero, zero, gradient).s;
  machine.attach(
      joint.name,
      std::make_shared<mechanism::MeasureJoint>(
          mechanism::MeasureJoint::Parameters{built.measure, joint.value.value_or(described),
                                              turns ? "torque" : "force", turns ? "N m" : "N", joint.reaction_unit},
          joint.law),
      built.measures);
}

void attach_on_measure(coupling::Machine &machine, const ElementRequest &element)
{
  const coupling::NamedMeasure &measure  = machine.measure(element.on);
  auto                          measures = measure.measures;
  for (const LagRequest &lag : element.lags)
    measures.push_back({{machine.add_lag(lag.name, lag.time_constant), 1.}});
  machine.attach(element.name, std::make_shared<mechanism::TransmittedElement>(measure.measure, element.element),
                 measures, element.kind);
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

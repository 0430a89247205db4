#include "apps/scene/joints/joined_pair.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::apps
{
namespace
{

using coupling::Body;
using coupling::BodyKind;
using mechanism::PlacedMeasure;
using mechanism::Placement;
using mechanism::RelativeMeasure;
using mechanism::Vector3d;
using Form = RelativeMeasure::Form;

/// Effect of measure i on the two bodies: largest displacement [m] per unit, or with a rotation the share of rotation.
struct Reach
{
  double translation, rotation;
};

Reach reach_of(const Pair &pair, int i)
{
  const int        n_1   = pair.first.n_measures();
  const Placement &place = i < n_1 ? pair.first : pair.second;
  const int        own   = i < n_1 ? i : i - n_1;
  return {place.translation(own).norm(), place.rotation(own).norm()};
}

} // namespace

Vector3 point_of(const coupling::MachineModel &machine, const PlaceRequest &place)
{
  return place.at ? *place.at : machine.position(place.marker);
}

coupling::PlacedPoint placed(const coupling::MachineModel &machine, const PlaceRequest &place)
{
  return machine.place(place.marker, point_of(machine, place));
}

double largest_gradient(const Pair &pair, const RelativeMeasure &measure, int i)
{
  const auto [translation, rotation] = reach_of(pair, i);
  const bool is_length               = measure.form == Form::along || measure.form == Form::distance;
  return is_length ? translation + rotation * pair.size() : rotation;
}

void sample_motion(int k, const Pair &pair, double *u)
{
  for (int i = 0; i < int(pair.measures.size()); ++i)
    u[i] = 0.5 * std::sin(1. + 7.3 * i + 2.1 * k) * (reach_of(pair, i).translation > 0. ? pair.size() : 1.);
}

Pair::Pair(const coupling::MachineModel &machine, const PlaceRequest &from, const PlaceRequest &to)
    : n_frame(machine.n_frame())
{
  const auto a = placed(machine, from), b = placed(machine, to);
  first    = a.placement;
  second   = b.placement;
  measures = a.measures;
  measures.insert(measures.end(), b.measures.begin(), b.measures.end());
  for (const Body &body : machine.bodies())
  {
    if (body.name == from.marker)
      on_first = &body;
    if (body.name == to.marker)
      on_second = &body;
  }
}

const Body *Pair::planar() const
{
  for (const Body *body : {on_first, on_second})
    if (body && body->kind == BodyKind::planar)
      return body;
  return nullptr;
}

bool Pair::in_space() const
{
  return (on_first && on_first->kind == BodyKind::rigid) || (on_second && on_second->kind == BodyKind::rigid);
}

bool Pair::has_point() const
{
  return (on_first && on_first->kind == BodyKind::point) || (on_second && on_second->kind == BodyKind::point);
}

double Pair::at_start(const RelativeMeasure &measure) const
{
  const double zero[PlacedMeasure::max_measures] = {};
  double       gradient[PlacedMeasure::max_measures];
  return PlacedMeasure{first, second, measure}.evaluate(zero, zero, gradient).s;
}

double Pair::size() const
{
  const double size = first.size() + second.size();
  return size > 0. ? size : 1.;
}

bool Pair::moves(const RelativeMeasure &measure, int from) const
{
  struct Slope
  {
    double sum = 0., terms = 0.;
  };
  const double at_rest[PlacedMeasure::max_measures] = {};
  double       u[PlacedMeasure::max_measures], gradient[PlacedMeasure::max_measures];
  for (int sample = 0; sample < 3; ++sample)
  {
    sample_motion(sample, *this, u);
    PlacedMeasure{first, second, measure}.evaluate(u, at_rest, gradient);
    std::map<int, Slope> slopes; // by the coordinates of the machine
    for (std::size_t i = 0; i < measures.size(); ++i)
      for (const auto &[coordinate, weight] : measures[i])
        if (coordinate >= from)
        {
          Slope &slope = slopes[coordinate];
          slope.sum += gradient[i] * weight;
          slope.terms += largest_gradient(*this, measure, int(i)) * std::abs(weight);
        }
    for (const auto &[coordinate, slope] : slopes)
      if (std::abs(slope.sum) > immobile * slope.terms)
        return true;
  }
  return false;
}

std::vector<Vector3d> Pair::own_axes() const
{
  std::vector<Vector3d> axes;
  for (const Body *body : {on_first, on_second})
    if (body && (body->kind == BodyKind::rotor || body->kind == BodyKind::planar))
      axes.push_back(vector(body->axis));
  return axes;
}

/// Axes of rotors, before those of sliders.
std::vector<Vector3d> Pair::fixed_axes() const
{
  std::vector<Vector3d> axes;
  for (const BodyKind kind : {BodyKind::rotor, BodyKind::slider})
    for (const Body *body : {on_first, on_second})
      if (body && body->kind == kind)
        axes.push_back(vector(body->axis));
  return axes;
}

} // namespace gestell::apps

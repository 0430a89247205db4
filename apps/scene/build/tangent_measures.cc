#include "apps/scene/build/tangent_measures.h"

#include "fem/values/number_text.h"

#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using mechanism::Placement;
using mechanism::RelativeMeasure;
using mechanism::Vector3d;

Vector3d across(const Vector3d &d, const Vector3d &axis)
{
  return d - axis.dot(d) * axis;
}

/// Motion of the point `at` along the axis, per unit of measure i in the reference configuration.
double advance_of(const Placement &wheel, const Vector3d &at, const Vector3d &axis, int i)
{
  const double           zero[Placement::max_measures] = {};
  Placement::MovedVector x;
  wheel.position(zero, nullptr, x);
  return axis.dot(x.J.col(i) + wheel.rotation(i).cross(at - wheel.point()));
}

/// Adds factor (z_2 - z_1), the relative motion along the axis at the pitch point.
void add_advance(RelativeMeasure &tangent, const TangentsRequest &request, const Pair &pair, double factor)
{
  const Vector3d at  = pair.first.point() + request.pitch_point * tangent.a;
  const int      k_1 = pair.first.n_measures(), k = k_1 + pair.second.n_measures();
  for (int i = 0; i < k; ++i)
    tangent.ratios[std::size_t(i)] += i < k_1 ? -factor * advance_of(pair.first, at, vector(request.axis), i)
                                              : factor * advance_of(pair.second, at, vector(request.axis), i - k_1);
}

} // namespace

double centre_distance(const Placement &first, const Placement &second, const Vector3d &axis)
{
  const double distance = across(second.point() - first.point(), axis).norm();
  if (!(distance > 1e-9 * (first.point().norm() + second.point().norm())))
    throw std::invalid_argument(
        "the two wheels are coaxial, so no teeth are in mesh; couple them by a joint of type \"gear\" with a carrier");
  return distance;
}

RelativeMeasure tangent_of(const Placement &first, const Placement &second, const Vector3d &axis,
                           const std::array<double, 2> &radii, double f, RelativeMeasure::Form form)
{
  RelativeMeasure tangent;
  tangent.form       = form;
  tangent.distance_0 = centre_distance(first, second, axis);
  tangent.a          = across(second.point() - first.point(), axis) / tangent.distance_0;
  tangent.b          = axis.cross(tangent.a);
  tangent.reach      = radii[0] + radii[1];
  tangent.flank      = f;
  for (int i = 0; i < first.n_measures(); ++i)
    tangent.ratios.push_back(radii[0] * first.rotation(i).dot(axis));
  for (int i = 0; i < second.n_measures(); ++i)
    tangent.ratios.push_back(radii[1] * second.rotation(i).dot(axis));
  return tangent;
}

std::vector<RelativeMeasure> tangent_measures(const TangentsRequest &request, const Pair &pair)
{
  const Vector3d axis    = vector(request.axis);
  const auto     tangent = [&](double left)
  {
    const double    scale = left * request.factor;
    RelativeMeasure own =
        tangent_of(pair.first, pair.second, axis, {scale * request.first, -scale * request.second}, request.factor,
                   request.winds ? RelativeMeasure::Form::gear : RelativeMeasure::Form::strand);
    if (request.advance != 0.)
      add_advance(own, request, pair, left * request.advance);
    return own;
  };
  return {tangent(1.), tangent(-1.),
          tangent_of(pair.first, pair.second, axis, {0., 0.}, 1., RelativeMeasure::Form::strand)};
}

PlaceRequest on_own_axis(const coupling::MachineModel &machine, const PlaceRequest &place, double distance)
{
  PlaceRequest moved = place;
  for (const coupling::Body &body : machine.bodies())
    if (body.name == place.marker && body.kind == coupling::BodyKind::rotor)
    {
      const Vector3d axis = vector(body.axis), arm = vector(point_of(machine, place)) - vector(body.centre);
      // A bearing's centre found from the mesh of its bore misses that of the drawing by a share of the mesh size.
      constexpr double seen = 1e-3;
      if (const double beside = across(arm, axis).norm(); beside > seen * distance)
        throw std::invalid_argument("the wheel's centre on \"" + body.name + "\" is " + short_text(beside) +
                                    " m off the axis of this rotor; give the point of this axis in the plane of the "
                                    "wheels, or use a body of type \"planar\" if it is eccentric");
      const Vector3d at = vector(body.centre) + axis.dot(arm) * axis;
      moved.at          = {at[0], at[1], at[2]};
    }
  return moved;
}

} // namespace gestell::apps

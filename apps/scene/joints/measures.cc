#include "apps/scene/file/typed_table.h"
#include "apps/scene/joints/joint_keys.h"
#include "apps/scene/joints/joint_types.h"
#include "apps/scene/read/read_scalars.h"
#include "apps/scene/read/relative_motion.h"
#include "fem/values/vector3.h"

#include <Eigen/Geometry>

#include <cmath>

namespace gestell::apps
{
namespace
{

using Form    = mechanism::RelativeMeasure::Form;
using Carrier = mechanism::RelativeMeasure::Carrier;

constexpr const char *measure_signals = "`value`, `rate`, `acceleration`";

/// Reads a measure of two points, with the directions from its keys.
MeasureRequest read_between(const SceneTable &table, const Names &names, Form form, const std::string &unit)
{
  auto measure   = table.filled<MeasureRequest>();
  measure.form   = form;
  measure.unit   = unit;
  measure.first  = names.place(table, "from", "at_from");
  measure.second = names.place(table, "to", "at_to", "ground");
  if (measure.first.marker == measure.second.marker)
    throw table.error("to", "is on '" + measure.second.marker + "', the body of `from`; the measure would be constant");
  return measure;
}

/// Body that carries the direction of `along`.
Carrier read_carrier(const SceneTable &table, const Names &names, const MeasureRequest &along)
{
  if (!table.has("carried_by"))
    return Carrier::space;
  const std::string carrier = names.marker(table, "carried_by");
  if (carrier == along.first.marker)
    return Carrier::first;
  if (carrier == along.second.marker)
    return Carrier::second;
  throw table.error("carried_by", "is '" + carrier + "', but the direction can rotate with `from` or `to` only, '" +
                                      along.second.marker + "' or '" + along.first.marker + "'");
}

MeasureRequest read_distance_of(const SceneTable &table, const Names &names)
{
  return read_between(table, names, Form::distance, "m");
}

MeasureRequest read_along(const SceneTable &table, const Names &names)
{
  MeasureRequest along = read_between(table, names, Form::along, "m");
  std::swap(along.first, along.second); // motion of `from` against `to`
  along.carrier = read_carrier(table, names, along);
  return along;
}

MeasureRequest read_inclination(const SceneTable &table, const Names &names)
{
  const auto line = read_between(table, names, Form::inclination, "rad");
  if (std::abs(fem::dot(line.a, line.b)) > 1e-9)
    throw table.error("towards", "must be perpendicular to 'zero', from which the angle grows towards it");
  return line;
}

/// A sum of rotations, unless a body is a free spatial one.
MeasureRequest read_angle(const SceneTable &table, const Names &names)
{
  MeasureRequest     angle = read_between(table, names, Form::angle, "rad");
  const std::string &from = angle.first.marker, &to = angle.second.marker;
  refuse_turning_point(table, names, angle.first, angle.second);
  const Vector3 about = table.direction("about");
  if (!turns_freely(names, from) && !turns_freely(names, to))
  {
    angle.form  = Form::along;
    angle.terms = {{1., difference(from, to, about, true), nullptr}};
    return angle;
  }
  std::swap(angle.first, angle.second); // of `from` against `to`
  const Eigen::Vector3d axis(about.data()), zero = axis.unitOrthogonal(), ahead = axis.cross(zero);
  angle.a = {zero[0], zero[1], zero[2]};
  angle.b = {ahead[0], ahead[1], ahead[2]};
  return angle;
}

} // namespace

MeasureType position_function_measure(), gear_mesh_measure();

const std::vector<MeasureType> &measure_types()
{
  static const auto types = with_type<MeasureType>(
      {{"distance", "Distance of two points.", measure_signals, place_on_ground(), read_distance_of},
       {"along",
        "Displacement of `from` relative to `to` along a direction that is fixed in space or, with `carried_by`, "
        "rotates with one of the two.",
        measure_signals,
        joined({place_on_ground(),
                {key::direction("direction", "direction of the displacement").into(&MeasureRequest::a),
                 key::named("carried_by", "body or interface (one of the two) with which the direction rotates")
                     .by_default("none")}}),
        read_along},
       {"inclination", "Angle of the line from `from` to `to`, -180 to 180 degrees.", measure_signals,
        joined({place_on_ground(),
                {key::direction("zero", "direction of the line at angle zero").into(&MeasureRequest::a),
                 key::direction("towards", "direction towards which the angle grows, perpendicular to `zero`")
                     .into(&MeasureRequest::b)}}),
        read_inclination},
       {"angle",
        "Rotation of the body or interface `from` relative to `to` about an axis, zero in the reference configuration. "
        "For a rigid body the axis rotates with `to`, and the angle is between -180 and 180 degrees. An element `on` "
        "this measure applies a torque, also to a rigid body.",
        measure_signals, joined({place_on_ground(), {key::direction("about", "axis of the angle")}}), read_angle},
       position_function_measure(),
       {"sum",
        "Sum of terms (factor times motion), all lengths or all angles. A clearance `on` it is the backlash of a gear.",
        measure_signals,
        {key::composed("terms", Key::Form::tables, kind::number,
                       {key::named("of", "[a measure or coordinate](#places-and-measures)"),
                        key::plain("factor", Key::Form::quantity,
                                   "factor of the term; a plain number has the unit that the term needs")
                            .by_default(1.)},
                       "terms of the sum, `[{ of = \"rack\" }, { of = \"pinion\", factor = \"-40 mm\" }]`")},
        read_sum},
       gear_mesh_measure()});
  return types;
}

} // namespace gestell::apps

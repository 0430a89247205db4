#include "apps/scene/joints/joint_keys.h"
#include "apps/scene/joints/joint_types.h"
#include "apps/scene/read/relative_motion.h"
#include "fem/values/vector3.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

/// A gear whose wheels are carried by a third body: their motions count against it (Willis).
void read_carried_gear(const SceneTable &table, const Names &names, JointRequest &joint)
{
  const std::string carrier = names.marker(table, "carrier");
  refuse_in_space(table, "carrier", carrier, names);
  for (const bool first : {true, false})
  {
    const std::string  key    = first ? "from" : "to";
    const std::string &marker = first ? joint.from.marker : joint.to.marker;
    const BodyRequest *body   = names.find_body(marker);
    if (!body || body->kind == coupling::BodyKind::point || body->kind == coupling::BodyKind::rigid)
      throw table.error(key, "a gear couples angles of rotors and planar bodies, or displacements of sliders");
    if (marker == carrier)
      throw table.error("carrier",
                        "is '" + carrier + "', the same as `" + key + "`; it must be the carrier of the wheels");
    const bool slides = body->kind == coupling::BodyKind::slider;
    joint.measure.terms.push_back(
        {first ? -joint.ratio : 1., difference(marker, carrier, body->axis, !slides), nullptr});
    joint.measure.unit = slides ? "m" : "rad";
  }
}

void read_gear(const SceneTable &table, const Names &names, JointRequest &joint)
{
  read_joined_places(table, names, joint);
  joint.holds_rotations = !table.has("carrier");
  if (table.has("carrier"))
    read_carried_gear(table, names, joint);
}

std::vector<Key> gear_mesh_keys()
{
  return joined({two_places(),
                 {key::direction("axis", "axis of both wheels").into(&MeshRequest::axis),
                  key::number("ratio", kind::number,
                              "angle of `to` per angle of `from`, relative to the line of centres: negative for two "
                              "external gears, positive for a ring gear; `\"-18/24\"`")
                      .into(&MeshRequest::ratio),
                  key::number("pressure_angle", kind::angle,
                              "pressure angle of the flank that carries positive `force`, negative for the other "
                              "flank; between -45 and 45 degrees")
                      .by_default(&MeshRequest::pressure_angle)}});
}

/// The teeth of two wheels: the way along their line of action.
MeasureRequest read_gear_mesh(const SceneTable &table, const Names &names)
{
  MeasureRequest measure;
  measure.form   = mechanism::RelativeMeasure::Form::gear;
  measure.unit   = "m";
  measure.first  = names.place(table, "from", "at_from");
  measure.second = names.place(table, "to", "at_to");
  check_two_places(table, measure.first, measure.second);
  const auto mesh = table.filled<MeshRequest>();
  for (const bool first : {true, false})
  {
    const std::string &marker = first ? measure.first.marker : measure.second.marker;
    refuse_in_space(table, first ? "from" : "to", marker, names);
    const BodyRequest *body = names.find_body(marker);
    if (turns_about_own_axis(body) && std::abs(std::abs(fem::dot(body->axis, mesh.axis)) - 1.) > 1e-9)
      throw table.error("axis", "is not that of '" + marker + "'; meshing wheels rotate about parallel axes");
  }
  if (mesh.ratio == 0. || mesh.ratio == 1.)
    throw table.error("ratio", "must not be 0 or 1: negative for two external wheels, positive with a ring gear");
  if (!(std::abs(mesh.pressure_angle) < 0.25 * M_PI))
    throw table.error("pressure_angle", "must be between -45 and 45 degrees");
  measure.mesh = mesh;
  return measure;
}

} // namespace

JointType gear_type()
{
  JointType type{
      "gear",
      "Coordinate of `to` = `ratio` times that of `from`: angles of rotors and planar bodies, displacements of "
      "sliders. With `carrier` both are relative to it (Willis equation), and it takes the remaining torque.",
      "`torque` or `force` on `to`",
      joined({one_point(),
              {key::number("ratio", kind::number, "ratio of the coordinates").into(&JointRequest::ratio),
               key::named("carrier", "body or interface that carries the wheels").by_default("none")}}),
      read_gear,
      [](JointEquations &equations, const JointRequest &joint) { equations.gear(joint.ratio); }};
  type.is_coupling = true;
  return type;
}

JointType gear_mesh_type()
{
  return {"gear mesh",
          "Couples the angles of two gears relative to the line of their centres. Different bodies may carry them. The "
          "radii follow from the distance of the centres `at_from` and `at_to` in the reference configuration. For a "
          "fixed ring gear, `to` is `\"ground\"`, a body or an interface.",
          "tooth `force`, positive if it turns `to` positively about `axis`", gear_mesh_keys(),
          [](const SceneTable &table, const Names &names, JointRequest &joint)
          { joint.measure = read_gear_mesh(table, names); }};
}

MeasureType gear_mesh_measure()
{
  return {"gear mesh",
          "Displacement along the line of action of two gears, as for the [joint](#gear-mesh-1). With a clearance or "
          "spring `on` it, the mesh is elastic with backlash.",
          "`value`, `rate`, `acceleration`", gear_mesh_keys(), read_gear_mesh};
}

} // namespace gestell::apps

#include "apps/scene/read/joint_keys.h"

#include "apps/scene/read/read_compliance.h"
#include "apps/scene/read/read_function.h"
#include "apps/scene/read/read_joint_friction.h"
#include "apps/scene/read/read_motion.h"

namespace gestell::apps
{
namespace
{

using Keys = std::vector<Key>;

Key from_key()
{
  return key::named("from", "body, frame.INTERFACE, ground or place");
}

Key to_key()
{
  return key::named("to", "the other one");
}

Key at_key(const std::string &name, const std::string &meaning)
{
  return key::vector(name, kind::length, meaning).by_default("its own point");
}

/// Two places, each with a point of its own.
Keys two_places()
{
  return {from_key(), to_key(), at_key("at_from", "point of `from`, as described"),
          at_key("at_to", "the same of `to`")};
}

Keys one_point()
{
  return joined({two_places(), {at_key("at", "point of both, as described, in place of `at_from` and `at_to`")}});
}

/// Of joints that may yield.
Keys point_joint(const Keys &own)
{
  return joined({one_point(), own, compliance_keys()});
}

Key axis_key(const std::string &meaning)
{
  return key::direction("axis", meaning);
}

Keys motion_names()
{
  return {key::named("from", "motion of the input, [named](#places-and-measures) by a measure or coordinate"),
          key::named("to", "motion of the follower, likewise")};
}

Keys gear_mesh_keys()
{
  return joined({two_places(),
                 {axis_key("of both wheels"),
                  key::number("ratio", kind::number,
                              "angle of `to` for one of `from`, against the line of their centres: negative of two "
                              "outer wheels, positive with a ring, `\"-18/24\"`"),
                  key::number("pressure_angle", kind::angle,
                              "of the flank that carries while `force` is positive, negative of the other; between -45 "
                              "and 45 degrees")
                      .by_default(0.)}});
}

Keys wheel_keys(const Keys &places)
{
  return joined({places,
                 {key::number("radius", kind::length, "of the wheel").above_zero(),
                  key::direction("direction", "of the way, at right angles to the axis of the wheel")}});
}

Keys place_on_ground()
{
  Keys places = two_places();
  places[1]   = to_key().by_default("ground");
  return places;
}

std::vector<TypeOfTable> with_type(std::vector<TypeOfTable> types)
{
  std::vector<std::string> names;
  for (const TypeOfTable &type : types)
    names.push_back(type.name);
  for (TypeOfTable &type : types)
    type.keys.insert(type.keys.begin(), key::choice("type", names, false, "what it is"));
  return types;
}

/// Joints of two points, or of two bodies.
std::vector<TypeOfTable> place_joint_types()
{
  const Key friction = joint_friction_key();
  const Key axis     = axis_key("the line, which turns with `from`");
  return {
      {"revolute",
       "Holds the point `at` of both together; of planar bodies against a frame in their plane. Rotors and planar "
       "bodies in it must turn about parallel axes. Of a rigid body it needs the `axis` and holds it too; others may "
       "give the one they have.",
       "`fx`, `fy`, `fz`; of a rigid body with `axis` `mx` ...",
       point_joint(
           {axis_key("about which it turns").by_default("that of the bodies; demanded of a rigid one"), friction})},
      {"spherical", "Holds the point `at` of both together.", "`fx`, `fy`, `fz`", point_joint({friction})},
      {"universal",
       "Holds the point `at` of both together, and the two axes, one on each body, at right angles: the bars of a "
       "cross.",
       "`fx` ..., `torque`",
       point_joint({key::direction("axis_from", "axis on `from`"), key::direction("axis_to", "axis on `to`")})},
      {"cylindrical",
       "Holds `to` on the line through `at` along `axis`, which turns with `from`, and turning about it alone.",
       "`fx` ..., `mx` ...", point_joint({axis, friction})},
      {"rigid", "Holds the point `at` together and their rotation against each other.",
       "`fx` ..., `torque`, or `mx` ...", point_joint({})},
      {"prismatic", "Holds `to` on a line along `axis`, which turns with `from`, and their rotation.",
       "`fx` ..., `torque`, or `mx` ...", point_joint({axis, friction})},
      {"in-plane", "Holds `to` in a plane across `axis`, which turns with `from`.", "`force`",
       point_joint({axis_key("across the plane"), friction})},
      {"distance", "Holds the distance of two places: a massless rod, a taut rope, a cylinder.",
       "`force`, positive where it pushes them apart",
       joined({two_places(),
               {key::number("length", kind::length, "distance").above_zero().by_default("as described"),
                key::table("motion", motion_law_keys(), "by which it grows, from `length` on").by_default("none")}})}};
}

/// Joints of one equation on a scalar of the motion.
std::vector<TypeOfTable> scalar_joint_types()
{
  const Key axis = axis_key("the line, which turns with `from`");
  return {
      {"gear",
       "Coordinate of `to` = `ratio` times that of `from`: angles of rotors and planar bodies, displacements of "
       "sliders. With `carrier` both count against it (Willis), and it takes the rest of the torque.",
       "`torque` or `force` on `to`",
       joined({one_point(),
               {key::number("ratio", kind::number, "of the coordinates"),
                key::named("carrier", "body or interface that carries the wheels").by_default("none")}})},
      {"position function", "`to` = f(`from`): a cam, an indexing drive.",
       "`force` or `torque` on `to`, `reaction` on `from`", joined({motion_names(), position_function_keys()})},
      {"screw", "`to` advances along `axis`, which turns with `from`, by `pitch` per turn of it against `from`.",
       "`force` on `to`",
       joined({two_places(), {axis, key::number("pitch", kind::length, "way of one turn; negative: left-handed")}})},
      {"rolling",
       "The wheel `from`, a rotor or planar body, goes along `direction` of `to` by `radius` times its angle, without "
       "slip; that it stays on its line is another joint (`\"in-plane\"` through its centre) or contact. `at_to` lies "
       "on the line.",
       "`force` on `from`", wheel_keys(place_on_ground())},
      {"rack",
       "`to` moves along `direction`, which turns with it, by `radius` times the angle of `from`, a rotor or planar "
       "body.",
       "`force` on `to`", wheel_keys(two_places())},
      {"gear mesh",
       "Holds the angles of two wheels against the line of their centres. The wheels may be carried by different "
       "bodies; radii follow from the distance of the centres, `at_from` and `at_to`, as described. A ring that is "
       "held is `to = "
       "\"ground\"`, a body or an interface.",
       "`force` of the teeth, positive where it turns `to` positively about `axis`", gear_mesh_keys()},
      {"prescribed motion",
       "`on` = `initial` + f(t).",
       "`force` or `torque`, `power` that it feeds",
       {key::named("on", "[a motion](#places-and-measures)"), key::table("motion", motion_law_keys(), "f"),
        key::number("initial", kind::length, "value at the start").on_angle(kind::angle).by_default("as described")}}};
}

std::vector<TypeOfTable> make_measure_types()
{
  const std::string signals = "`value`, `rate`, `acceleration`";
  return with_type(
      {{"distance", "Distance of two places.", signals, place_on_ground()},
       {"along",
        "Motion of `from` against `to` along a direction fixed in space or, with `carried_by`, turning with one of the "
        "two.",
        signals,
        joined({place_on_ground(),
                {key::direction("direction", "that counts"),
                 key::named("carried_by", "body or interface of one of the two, with which the direction turns")
                     .by_default("none")}})},
       {"inclination", "Angle of the line from `from` to `to`, -180 to 180 degrees.", signals,
        joined({place_on_ground(),
                {key::direction("zero", "where it is zero"),
                 key::direction("towards", "towards which it grows, at right angles to `zero`")}})},
       {"angle",
        "Rotation of the body or interface `from` against `to` about an axis, zero as described. With a rigid body the "
        "axis turns with `to` and the angle lies between -180 and 180 degrees; a law on it is a torque, the way to put "
        "one on a rigid body.",
        signals, joined({place_on_ground(), {key::direction("about", "axis")}})},
       {"position function", "`to` - f(`from`): how far the follower `to` is off its cam.", signals,
        joined({motion_names(), position_function_keys()})},
       {"sum",
        "Sum of factor times motion; all terms must be lengths, or all angles. A clearance on it is the backlash of a "
        "gear.",
        signals,
        {key::composed("terms", Key::Form::tables, kind::number,
                       {key::named("of", "[a motion](#places-and-measures)"),
                        key::plain("factor", Key::Form::quantity,
                                   "of the term; without unit it takes the one that makes its term fit")
                            .by_default(1.)},
                       "`[{ of = \"rack\" }, { of = \"pinion\", factor = \"-40 mm\" }]`")}},
       {"gear mesh",
        "Way along the line of action of the teeth of two wheels, as of the [joint](#joints): a clearance or spring on "
        "it is an elastic gear with backlash.",
        signals, gear_mesh_keys()}});
}

} // namespace

const std::vector<TypeOfTable> &joint_types()
{
  static const std::vector<TypeOfTable> types = []
  {
    std::vector<TypeOfTable> all = place_joint_types();
    for (const TypeOfTable &type : scalar_joint_types())
      all.push_back(type);
    return with_type(all);
  }();
  return types;
}

const std::vector<TypeOfTable> &measure_types()
{
  static const std::vector<TypeOfTable> types = make_measure_types();
  return types;
}

const std::vector<Key> &keys_of(const std::vector<TypeOfTable> &types, const std::string &name)
{
  for (const TypeOfTable &type : types)
    if (type.name == name)
      return type.keys;
  throw std::logic_error("no type '" + name + "' is declared");
}

const std::vector<Key> &place_keys()
{
  static const std::vector<Key> keys = {key::named("on", "body, frame.INTERFACE or ground"),
                                        key::vector("at", kind::length, "in the position the scene describes")};
  return keys;
}

} // namespace gestell::apps

#include "apps/scene/read/read_bodies.h"

#include "apps/scene/read/read_part.h"
#include "apps/scene/read/read_tensor.h"
#include "fem/values/number_text.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

Key type_key()
{
  return key::choice("type", {"rotor", "slider", "point", "planar", "rigid"}, false, "what it is");
}

/// Mass [kg] and position, which every body has; `cad` tells them, too.
Key mass_key()
{
  return key::number("mass", kind::mass, "of the body; with `cad` spread evenly, in place of `material`").above_zero();
}

Key centre_key()
{
  return key::vector("position", kind::length, "its centre of mass")
      .by_default("demanded; with `cad` that of the shape");
}

Key drawn_size()
{
  return key::vector("size", kind::length, "drawn as a box `[x, y, z]`").by_default("[0, 0, 0]");
}

Key drawn_radius(const std::string &as)
{
  return key::number("radius", kind::length, "drawn as " + as + " of this radius").from_zero().by_default(0.);
}

Key inertia_key(const std::string &about)
{
  return key::number("inertia", kind::inertia, about).above_zero().by_default("demanded; with `cad` that of the shape");
}

Key tensor_key()
{
  return key::vector("inertia", kind::inertia,
                     "about its centre of mass, moments `[Jx, Jy, Jz]` about the global axes in the position the scene "
                     "describes, or the tensor `[[Jxx, Jxy, Jxz], ...]`; a body has thickness: no moment reaches the "
                     "sum of the others")
      .also({Key::Form::matrix})
      .by_default("demanded; with `cad` that of the shape");
}

Key given_mass_key()
{
  return mass_key().by_default("demanded; with `cad` by its density");
}

Key normal_key()
{
  return key::direction("normal", "across its plane; the angle is positive about it");
}

std::vector<Key> unbalance_keys()
{
  return {
      key::number("unbalance", kind::unbalance, "mass times eccentricity of its centre of mass")
          .from_zero()
          .by_default("none"),
      key::number("unbalance_phase", kind::angle,
                  "where the centre of mass lies at zero angle, in the positive sense of turning from the first global "
                  "axis across `axis`")
          .by_default(0.),
      key::vector("unbalance_position", kind::length, "the point of its axis that the unbalance is at")
          .by_default("`position`, or where its carrier is if there is none")};
}

/// @throws the error of the table for keys without an unbalance, and an eccentric mass that turns harder than the rotor
std::optional<UnbalanceRequest> read_unbalance(const SceneTable &table)
{
  if (!table.has("unbalance"))
  {
    for (const char *key : {"unbalance_phase", "unbalance_position"})
      if (table.has(key))
        throw table.error(std::string("has '") + key +
                          "' but no 'unbalance'; give it, such as unbalance = \"2.4 g m\"");
    return std::nullopt;
  }
  UnbalanceRequest unbalance;
  unbalance.amount = table.value("unbalance");
  unbalance.phase  = table.value("unbalance_phase");
  for (const char *key : {"position", "unbalance_position"})
    if (table.has(key))
      unbalance.position = table.vector(key);
  return unbalance;
}

/// J about the axis is that of the mass at its eccentricity and what lies about it: J >= m e^2 = U^2/m.
void check_unbalance(const SceneTable &table, const BodyRequest &body)
{
  if (const double U = body.unbalance ? body.unbalance->amount : 0.; U * U > body.mass * body.inertia && body.mass > 0.)
    throw table.error("its unbalance of " + short_text(U) + " kg m puts its " + short_text(body.mass) + " kg " +
                      short_text(U / body.mass) + " m off its axis, about which it would have at least " +
                      short_text(U * U / body.mass) + " kg m^2; inertia is " + short_text(body.inertia) + " kg m^2");
}

std::vector<BodyType> make_types()
{
  const std::vector<Key> type = {type_key()};
  return {
      {"rotor", "One angle about an axis.",
       joined({type,
               {key::direction("axis", "about which it turns"),
                key::named("on", "what carries it: `\"frame.NAME\"`, a body or `\"ground\"`").by_default("ground"),
                inertia_key("about its axis"),
                key::number("mass", kind::mass, "at the carrier; with `cad` spread evenly, in place of `material`")
                    .from_zero()
                    .by_default(0.),
                key::vector("position", kind::length,
                            "where it is drawn, at zero displacement; on the ground it turns about it")
                    .by_default("[0, 0, 0]; with `cad` the centre of mass"),
                drawn_radius("a disc")},
               unbalance_keys(),
               part_keys()})},
      {"slider", "One displacement along an axis.",
       joined(
           {type,
            {key::direction("axis", "along which it moves"),
             key::named("guide", "what it moves with sideways").by_default("ground"), given_mass_key(),
             key::vector("position", kind::length, "where it is drawn, at zero displacement").by_default("[0, 0, 0]"),
             drawn_size()},
            part_keys()})},
      {"point", "A mass free in space.",
       joined({type, {given_mass_key(), centre_key(), drawn_size(), drawn_radius("a sphere")}, part_keys()})},
      {"planar", "A body that moves in a plane and turns about its normal by any angle.",
       joined({type,
               {normal_key(), given_mass_key(), inertia_key("about its centre of mass, about the normal"), centre_key(),
                drawn_size(), drawn_radius("a plate with a rim")},
               part_keys()})},
      {"rigid", "A body that moves and turns freely in space.",
       joined({type,
               {given_mass_key(), tensor_key(), principal_axes_key(), centre_key(), drawn_size(),
                drawn_radius("a sphere")},
               part_keys()})}};
}

const std::vector<Key> &body_keys(const std::string &type)
{
  for (const BodyType &known : body_types())
    if (known.name == type)
      return known.keys;
  throw std::logic_error("no type of bodies: " + type);
}

/// Names of the carriers may be bodies declared further down, so they are looked up once all are known.
BodyRequest read_body(const SceneTable &any, const SceneTable &scene, fem::Scripts scripts)
{
  static const std::vector<Key> type_only = {type_key()};
  check_thing_name(any);
  BodyRequest body;
  body.name               = any.name();
  body.place              = any.place();
  const std::string type  = any.declared(type_only).choice("type");
  const SceneTable  table = any.declared(body_keys(type));
  if (type == "point" || type == "planar" || type == "rigid")
  {
    body.kind = type == "point"    ? coupling::BodyKind::point
                : type == "planar" ? coupling::BodyKind::planar
                                   : coupling::BodyKind::rigid;
    if (type == "planar")
      body.axis = table.direction("normal");
    if (table.has("cad"))
    {
      read_part(any, scene, body, scripts);
      return body;
    }
    body.mass     = table.value("mass");
    body.position = table.vector("position");
    if (type == "planar")
      body.inertia = table.value("inertia");
    if (type == "rigid")
      body.tensor = read_tensor(table);
    body.size   = table.vector_or("size", {});
    body.radius = table.value("radius");
    return body;
  }
  const bool rotor = type == "rotor";
  body.kind        = rotor ? coupling::BodyKind::rotor : coupling::BodyKind::slider;
  body.axis        = table.direction("axis");
  if (rotor)
    body.unbalance = read_unbalance(table);
  if (table.has("cad"))
  {
    read_part(any, scene, body, scripts);
    return body;
  }
  body.position = table.vector_or("position", {});
  if (rotor)
  {
    body.inertia = table.value("inertia");
    body.mass    = table.value("mass");
    body.radius  = table.value("radius");
    check_unbalance(table, body);
  }
  else
  {
    body.mass = table.value("mass");
    body.size = table.vector_or("size", {});
  }
  return body;
}

/// Carriers must be added before what they carry.
std::vector<BodyRequest> carriers_first(const std::vector<BodyRequest> &bodies)
{
  std::vector<BodyRequest> sorted;
  const auto               done = [&](const std::string &name)
  { return std::any_of(sorted.begin(), sorted.end(), [&](const auto &body) { return body.name == name; }); };
  const auto is_body = [&](const std::string &name)
  { return std::any_of(bodies.begin(), bodies.end(), [&](const auto &body) { return body.name == name; }); };
  while (sorted.size() < bodies.size())
  {
    const auto before = sorted.size();
    for (const auto &body : bodies)
      if (!done(body.name) && (!is_body(body.carrier) || done(body.carrier)))
        sorted.push_back(body);
    if (sorted.size() == before)
      for (const auto &body : bodies)
        if (!done(body.name))
          throw std::invalid_argument(body.place + ": is carried by '" + body.carrier +
                                      "', which it carries itself; let one of them stand on the frame or the ground");
  }
  return sorted;
}

} // namespace

const std::vector<BodyType> &body_types()
{
  static const std::vector<BodyType> types = make_types();
  return types;
}

std::vector<BodyRequest> read_bodies(const SceneTable &scene, Names &names, fem::Scripts scripts)
{
  std::vector<BodyRequest> bodies;
  const auto               tables = scene.tables("body");
  for (const auto &table : tables)
  {
    bodies.push_back(read_body(table, scene, scripts));
    names.add_body(bodies.back());
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (bodies[i].kind == coupling::BodyKind::rotor || bodies[i].kind == coupling::BodyKind::slider)
    {
      bodies[i].carrier =
          names.marker(tables[i], bodies[i].kind == coupling::BodyKind::rotor ? "on" : "guide", "ground");
      names.set_carrier(bodies[i].name, bodies[i].carrier);
    }
  return carriers_first(bodies);
}

} // namespace gestell::apps

#include "apps/scene/bodies/body_types.h"

#include "apps/scene/file/typed_table.h"
#include "apps/scene/read/read_part.h"

namespace gestell::apps
{

BodyType rotor_type(), slider_type(), point_type(), planar_type(), rigid_body_type();

const std::vector<BodyType> &body_types()
{
  static const auto types =
      with_type(made<BodyType>(rotor_type, slider_type, point_type, planar_type, rigid_body_type));
  return types;
}

const BodyType &body_type(coupling::BodyKind kind)
{
  return *std::find_if(body_types().begin(), body_types().end(), [&](const auto &type) { return type.kind == kind; });
}

Key mass_key()
{
  return key::number("mass", kind::mass,
                     "mass of the body; with `cad` it is distributed uniformly and replaces `material`")
      .above_zero()
      .by_default("required; with `cad` density times volume")
      .unless("cad")
      .into(&BodyRequest::mass);
}

Key centre_key()
{
  return key::vector("position", kind::length, "centre of mass")
      .by_default("required; with `cad` that of the shape")
      .unless("cad")
      .into(&BodyRequest::position);
}

Key drawn_size()
{
  return key::vector("size", kind::length, "drawn as a box `[x, y, z]`")
      .by_default("[0, 0, 0]")
      .into(&BodyRequest::size);
}

Key drawn_radius(const std::string &as)
{
  return key::number("radius", kind::length, "drawn as " + as + " of this radius")
      .from_zero()
      .by_default(&BodyRequest::radius);
}

Key inertia_key(const std::string &about)
{
  return key::number("inertia", kind::inertia, about)
      .above_zero()
      .by_default("required; with `cad` that of the shape")
      .unless("cad")
      .into(&BodyRequest::inertia);
}

namespace
{

/// A carrier may be a body declared later, so its name is resolved when all bodies are known.
BodyRequest read_body(const SceneTable &any, const SceneTable &scene, fem::Scripts scripts)
{
  check_thing_name(any);
  const BodyType  &type  = type_of(any, body_types());
  const SceneTable table = any.declared(type.keys);
  BodyRequest      body;
  body.name  = any.name();
  body.place = any.place();
  body.kind  = type.kind;
  table.fill(body);
  if (type.read)
    type.read(table, body);
  if (table.has("cad"))
    read_part(any, scene, body, scripts);
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
                                      "', which in turn is carried by it; put one of them on the frame or the ground");
  }
  return sorted;
}

} // namespace

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
    if (const char *key = body_type(bodies[i].kind).carrier)
    {
      bodies[i].carrier = names.marker(tables[i], key, "ground");
      names.set_carrier(bodies[i].name, bodies[i].carrier);
    }
  return carriers_first(bodies);
}

} // namespace gestell::apps

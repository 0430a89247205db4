#include "apps/scene/read/read_bodies.h"

#include "apps/scene/read/read_part.h"
#include "apps/scene/read/read_tensor.h"
#include "fem/values/nearest_name.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

/// Names of the carriers may be bodies declared further down, so they are looked up once all are known.
BodyRequest read_body(const SceneTable &table, const SceneTable &scene, fem::Scripts scripts)
{
  check_thing_name(table);
  BodyRequest body;
  body.name              = table.name();
  body.place             = table.place();
  const std::string type = table.choice("type", {"rotor", "slider", "point", "planar", "rigid"}, "");
  if (type == "point" || type == "planar" || type == "rigid")
  {
    body.kind = type == "point"    ? coupling::BodyKind::point
                : type == "planar" ? coupling::BodyKind::planar
                                   : coupling::BodyKind::rigid;
    if (type == "planar")
      body.axis = table.direction("normal");
    if (table.has("cad"))
    {
      read_part(table, scene, body, scripts);
      return body;
    }
    body.mass     = table.positive("mass", kind::mass);
    body.position = table.vector("position", kind::length);
    if (type == "planar")
      body.inertia = table.positive("inertia", kind::inertia);
    if (type == "rigid")
      body.tensor = read_tensor(table);
    body.size   = table.vector("size", kind::length, {});
    body.radius = table.not_negative("radius", kind::length, 0.);
    return body;
  }
  const bool rotor = type == "rotor";
  body.kind        = rotor ? coupling::BodyKind::rotor : coupling::BodyKind::slider;
  body.axis        = table.direction("axis");
  if (table.has("cad"))
  {
    read_part(table, scene, body, scripts);
    return body;
  }
  body.position = table.vector("position", kind::length, {});
  if (rotor)
  {
    body.inertia = table.positive("inertia", kind::inertia);
    body.mass    = table.not_negative("mass", kind::mass, 0.);
    body.radius  = table.not_negative("radius", kind::length, 0.);
  }
  else
  {
    body.mass = table.positive("mass", kind::mass);
    body.size = table.vector("size", kind::length, {});
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
                                      "', which it carries itself; let one of "
                                      "them stand on the frame or the ground");
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
    if (bodies[i].kind == coupling::BodyKind::rotor || bodies[i].kind == coupling::BodyKind::slider)
    {
      bodies[i].carrier =
          names.marker(tables[i], bodies[i].kind == coupling::BodyKind::rotor ? "on" : "guide", "ground");
      names.set_carrier(bodies[i].name, bodies[i].carrier);
    }
  return carriers_first(bodies);
}

} // namespace gestell::apps

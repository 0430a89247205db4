#include "apps/scene/read_bodies.h"

#include "apps/scene/element_registry.h"
#include "apps/scene/read_part.h"
#include "apps/scene/read_switches.h"
#include "coupling/nearest_name.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

/// Two directions at right angles and the third one that goes with them, as columns.
Eigen::Matrix3d read_axes(const SceneTable &table)
{
  const auto      rows = table.matrix("principal_axes", kind::number);
  Eigen::Matrix3d axes;
  if (rows.size() != 2 || rows[0].size() != 3)
    throw table.error("principal_axes", "needs two directions [[x, y, z], [x, y, z]], those of the first two moments; "
                                        "the third is at right angles to both");
  for (int i = 0; i < 2; ++i)
    axes.col(i) = Eigen::Vector3d(rows[i].data());
  const double a = axes.col(0).norm(), b = axes.col(1).norm();
  if (!(a > 0.) || !(b > 0.) || std::abs(axes.col(0).dot(axes.col(1))) > 1e-9 * a * b)
    throw table.error("principal_axes", "needs two directions at right angles to each other");
  axes.col(0) /= a;
  axes.col(1) /= b;
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

/// Inertia tensor in global axes from three moments or from the tensor itself.
Eigen::Matrix3d read_tensor(const SceneTable &table)
{
  const std::string needed = "needs three moments [Jx, Jy, Jz], or the tensor as three rows [[Jxx, Jxy, Jxz], ..]";
  if (table.has("inertia") && !table.is_array("inertia"))
    throw table.error("inertia", needed + " of the body about its centre of mass");
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  if (table.is_matrix("inertia"))
  {
    const auto rows = table.matrix("inertia", kind::inertia);
    if (rows.size() != 3 || rows[0].size() != 3)
      throw table.error("inertia", needed);
    if (table.has("principal_axes"))
      throw table.error("principal_axes", "goes with three moments; a tensor tells its axes itself");
    for (int i = 0; i < 3; ++i)
      J.row(i) = Eigen::RowVector3d(rows[i].data());
    return J;
  }
  const Vector3 moments = table.vector("inertia", kind::inertia);
  J.diagonal()          = Eigen::Vector3d(moments.data());
  if (!table.has("principal_axes"))
    return J;
  const Eigen::Matrix3d axes = read_axes(table);
  return axes * J * axes.transpose();
}

/// Names of the carriers may be bodies declared further down, so they are looked up once all are known.
BodyRequest read_body(const SceneTable &table, const SceneTable &scene)
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
      read_part(table, scene, body);
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
    read_part(table, scene, body);
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

std::vector<BodyRequest> read_bodies(const SceneTable &scene, Names &names)
{
  std::vector<BodyRequest> bodies;
  const auto               tables = scene.tables("body");
  for (const auto &table : tables)
  {
    bodies.push_back(read_body(table, scene));
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

void read_elements(const SceneTable &table, const Names &names, Scene &scene)
{
  std::vector<std::string> types;
  for (const auto &type : element_types())
    types.push_back(type.name);
  for (const auto &element : table.tables("element"))
  {
    check_thing_name(element);
    if (names.find_body(element.name()))
      throw element.error("a body has the name '" + element.name() + "' too; signals could not tell them apart");
    scene.element_places[element.name()] = element.place();
    const std::string type               = element.choice("type", types, "");
    for (const auto &known : element_types())
      if (known.name == type)
        known.read(element, names, scene);
    if (element.choice("initially", {"on", "off"}, "on") == "off")
      begin_off(element, scene);
  }
}

} // namespace gestell::apps

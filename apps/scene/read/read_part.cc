#include "apps/scene/read/read_part.h"

#include "apps/scene/read/read_material.h"
#include "coupling/plugin/frame_service_loader.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace gestell::apps
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d vector(const Vector3 &x)
{
  return Vector3d(x.data());
}

void place(fem::CadBody &part, const coupling::Placement &placement)
{
  const auto moved = [&](const Vector3d &x) -> Vector3d { return placement.at + placement.Q * x; };
  part.centre      = moved(part.centre);
  part.inertia     = placement.Q * part.inertia * placement.Q.transpose();
  for (auto &x : part.points)
  {
    const Vector3d there = moved(vector(x));
    x                    = {there[0], there[1], there[2]};
  }
}

/// Refuses keys whose values follow from the file; the density does not, and must be given once.
void check_keys(const SceneTable &table, coupling::BodyKind kind)
{
  const auto refuse = [&](const std::string &key, const std::string &why)
  {
    if (table.has(key))
      throw table.error(key, why);
  };
  refuse("inertia", "follows from the shape in `cad`; remove 'inertia' or 'cad'");
  refuse("principal_axes", "follow from the shape in `cad`; remove them");
  for (const std::string key : {"radius", "size"})
    refuse(key, "is not needed: the body is drawn as its `cad` shows it; remove it");
  const int densities = table.has("material") + table.has("density") + table.has("mass");
  if (densities != 1)
    throw table.error(densities == 0 ? "has a shape in `cad` and no density; give one of 'material' (such as "
                                       "\"steel\"), 'density' and 'mass' (uniformly distributed)"
                                     : "has more than one of 'material', 'density' and 'mass', each of which defines "
                                       "the density of the shape in `cad`; keep one of them");
  if (kind != coupling::BodyKind::rotor)
    refuse("position", "is the centre of mass of the shape in `cad`; move the part by placement = { origin = [x, y, z] "
                       "}, or remove it");
}

double read_density(const SceneTable &table, const SceneTable &scene, double volume)
{
  if (!table.has("mass"))
    return table.has("density") ? read_plausible_density(table) : read_weighed_material(table, scene).rho;
  const double mass = table.value("mass");
  warn_of_density(table, mass, volume);
  return mass / volume;
}

std::string triple(const Vector3d &x)
{
  std::ostringstream text;
  text.precision(6);
  text << '[' << x[0] << ", " << x[1] << ", " << x[2] << ']';
  return text.str();
}

/// Zeros that are only rounding are said to be zero.
Vector3d clean(const Vector3d &x, double scale)
{
  return x.unaryExpr([&](double value) { return std::abs(value) > 1e-9 * scale ? value : 0.; });
}

std::string found(const BodyRequest &body, const CadBodyRequest &part, const std::string &file)
{
  const fem::CadBody &shape = part.shape;
  const std::size_t   n     = shape.solids.size();
  std::ostringstream  text;
  text.precision(6);
  text << body.name << " from " << file << (n > 1 ? ", the sum of " + std::to_string(n) + " solids" : "") << ": "
       << body.mass << " kg (" << part.density << " kg/m^3), centre of mass "
       << triple(clean(shape.centre, std::cbrt(shape.volume))) << " m";
  if (body.kind == coupling::BodyKind::rotor)
    text << ", " << body.inertia << " kg m^2 about its axis";
  if (body.kind == coupling::BodyKind::planar)
    text << ", " << body.inertia << " kg m^2 about its normal";
  if (body.kind == coupling::BodyKind::rigid)
  {
    const Matrix3d &J = body.tensor;
    text << ", moments of inertia " << triple(J.diagonal()) << " kg m^2, products Jxy, Jxz, Jyz "
         << triple(clean({J(0, 1), J(0, 2), J(1, 2)}, J.trace())) << " kg m^2";
  }
  return text.str();
}

/// The service that reads CAD.
/// @throws an error at `cad` in a build without finite elements
coupling::FrameService &service(const SceneTable &table)
{
  try
  {
    return coupling::frame_service();
  }
  catch (const std::invalid_argument &e)
  {
    throw table.error("cad", e.what());
  }
}

/// J about the axis through x: that about the centre of mass and m e^2.
void read_rotor(const SceneTable &table, BodyRequest &body)
{
  const Vector3d centre = vector(body.position), axis = vector(body.axis);
  body.position             = table.vector_or("position", body.position);
  const double eccentricity = axis.cross(centre - vector(body.position)).norm();
  body.inertia += body.mass * eccentricity * eccentricity;
  // of a rotor, by its radius of gyration: far beyond what balancing leaves
  constexpr double seen_eccentricity = 1e-3;
  if (body.unbalance || eccentricity < seen_eccentricity * std::sqrt(body.inertia / body.mass))
    return;
  std::ostringstream text;
  text.precision(3);
  text << "the centre of mass is " << 1e3 * eccentricity
       << " mm off the axis, but a rotor is balanced. To include the unbalance, set unbalance = \""
       << 1e3 * body.mass * eccentricity << " g m\", or make it a planar or rigid body";
  table.warn("cad", text.str());
}

} // namespace

std::vector<Key> part_keys()
{
  return {key::plain("cad", Key::Form::file,
                     "CAD or mesh file: `.step .stp .brep .geo .msh .inp`, or a closed triangulated surface `.stl`. "
                     "Several solids are added; they must not overlap")
              .by_default("none: mass and inertia are given"),
          key::number("unit", kind::length, "length unit of a file without one, `\"1 mm\"`; required for `.stl`")
              .above_zero()
              .by_default("of the file"),
          material_key().by_default("`density` or `mass`"),
          key::number("density", kind::density, "density, instead of `material`; values that no solid has are an error")
              .above_zero()
              .by_default("of the material"),
          key::table("placement",
                     {key::vector("origin", kind::length, "position of the origin of the file").by_default("[0, 0, 0]"),
                      key::direction("axis", "axis of rotation of the file's coordinates").by_default("no rotation"),
                      key::number("angle", kind::angle, "angle of rotation").by_default("no rotation")},
                     "placement: rotation about `axis` through the origin of the file, which is then moved to `origin`")
              .by_default("the coordinates of the file are those of the scene in the reference configuration")};
}

coupling::Placement read_placement(const SceneTable &table)
{
  coupling::Placement placement;
  const auto          inner = table.optional_table("placement");
  if (!inner)
    return placement;
  placement.at = vector(inner->vector_or("origin", {}));
  if (inner->has("axis") != inner->has("angle"))
    throw inner->error(inner->has("axis") ? "has an axis and no angle" : "has an angle and no axis",
                       "the part is rotated by `angle` about `axis` through the origin of the file; give both");
  if (inner->declares("mirror") && inner->has("mirror"))
  {
    const Vector3d n = vector(inner->direction("mirror"));
    placement.Q -= 2. * n * n.transpose();
  }
  if (inner->has("axis"))
    placement.Q = Eigen::AngleAxisd(inner->value("angle"), vector(inner->direction("axis"))).matrix() * placement.Q;
  return placement;
}

void read_part(const SceneTable &any, const SceneTable &scene, BodyRequest &body, fem::Scripts scripts)
{
  static const std::vector<Key> keys = joined(
      {part_keys(), {key::number("mass", kind::mass, "").above_zero(), key::vector("position", kind::length, "")}});
  const SceneTable  table = any.declared(keys);
  const std::string file  = table.file("cad");
  check_keys(any, body.kind);
  const auto placement = read_placement(table);
  auto       part      = std::make_shared<CadBodyRequest>();
  part->shape          = service(table).measure({file, table.value_or("unit", 0.), table.place(), scripts});
  place(part->shape, placement);
  part->density = read_density(table, scene, part->shape.volume);

  const Vector3d axis = vector(body.axis);
  body.mass           = part->density * part->shape.volume;
  body.tensor         = part->density * part->shape.inertia;
  body.inertia        = axis.dot(body.tensor * axis);
  std::copy_n(part->shape.centre.data(), 3, body.position.begin());
  if (body.kind == coupling::BodyKind::rotor)
    read_rotor(table, body);
  part->found = found(body, *part, std::filesystem::path(file).filename().string());
  body.part   = part;
}

} // namespace gestell::apps

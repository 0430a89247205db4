#include "fem/geometry/face.h"

#include <algorithm>

namespace gestell::fem
{

namespace
{

bool recognise_plane(Face &face, double tolerance)
{
  const auto &[p, n] = face.samples.front();
  for (const auto &[point, normal] : face.samples)
    if (dot(normal, n) < 0. || norm(cross(normal, n)) > straight || std::abs(dot(point - p, n)) > tolerance)
      return false;
  face.kind      = FaceKind::plane;
  face.direction = n;
  face.through   = face.centre - dot(face.centre - p, n) * n;
  return true;
}

/// First component that is not zero made positive: an axis has no sense.
Vector3 without_sense(const Vector3 &a)
{
  for (const double component : a)
    if (std::abs(component) > 1e-6)
      return component < 0. ? -1. * a : a;
  return a;
}

/**
 * Two normals n0, n1 of a cylinder span its cross-section: a = n0 x n1.  With the points p0, p1 projected on it,
 *     p0 - p1 = k (n0 - n1),    centre c = p0 - k n0,    radius |k|.
 */
bool recognise_cylinder(Face &face, double tolerance)
{
  const auto  &first  = face.samples.front();
  const auto   turned = [&](const Face::Sample &sample) { return norm(cross(first.normal, sample.normal)); };
  const auto  &second = *std::max_element(face.samples.begin(), face.samples.end(),
                                          [&](const auto &a, const auto &b) { return turned(a) < turned(b); });
  const double slack  = face.faceted ? 0.1 : straight; // facets of a coarse mesh are not parallel to the axis
  if (turned(second) <= slack)
    return false;

  const Vector3 a   = without_sense(unit(cross(first.normal, second.normal)));
  const Vector3 dn  = first.normal - second.normal;
  const double  k   = dot(first.point - second.point, dn) / dot(dn, dn);
  const Vector3 c   = first.point - k * first.normal;
  const double  off = face.faceted ? 0.1 * std::abs(k) : tolerance;
  for (const auto &[point, normal] : face.samples)
    if (std::abs(dot(normal, a)) > slack || std::abs(norm(cross(point - c, a)) - std::abs(k)) > off)
      return false;
  face.kind      = FaceKind::cylinder;
  face.direction = a;
  face.through   = c + dot(face.centre - c, a) * a;
  face.radius    = std::abs(k);
  return true;
}

} // namespace

void recognise(Face &face, double tolerance)
{
  if (face.samples.empty() || recognise_plane(face, tolerance))
    return;
  recognise_cylinder(face, tolerance);
}

std::string describe(const Face &face)
{
  std::string line = "face " + std::to_string(face.tag);
  line += face.name.empty() ? "" : " \"" + face.name + "\"";
  for (const std::string &group : face.groups)
    line += " [" + group + "]";
  if (face.kind == FaceKind::plane)
    line += ": plane, normal " + text(face.direction) + ", through " + text(face.through);
  else if (face.kind == FaceKind::cylinder)
    line += ": cylinder, axis " + text(face.direction) + ", through " + text(face.through) + ", radius " +
            text(face.radius);
  else
    line += ": " + face.type + ", centre " + text(face.centre);
  return line + ", area " + text(face.area) + " m^2, from " + text(face.min) + " to " + text(face.max);
}

} // namespace gestell::fem

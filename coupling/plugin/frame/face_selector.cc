#include "coupling/plugin/frame/face_selector.h"

#include "fem/geometry/surface_selection.h"
#include "fem/values/number_text.h"

#include <cmath>
#include <optional>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using fem::SurfaceSelector;
using fem::operator+, fem::operator-, fem::operator*;
using fem::Vector3;

/// Rounds to 0.1 um, directions to 1e-7: far below the tolerances of selectors.
double rounded_off(double x)
{
  return std::round(x * 1e7) * 1e-7 + 0.;
}

Vector3 rounded_off(const Vector3 &v)
{
  return {rounded_off(v[0]), rounded_off(v[1]), rounded_off(v[2])};
}

std::string toml(double x)
{
  return short_text(x, 8);
}

std::string toml(const Vector3 &v)
{
  return "[" + toml(v[0]) + ", " + toml(v[1]) + ", " + toml(v[2]) + "]";
}

/// A text of TOML in quotes.
std::string toml(const std::string &text)
{
  std::string quoted = "\"";
  for (const char c : text)
    quoted += (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  return quoted + "\"";
}

std::string toml(const SurfaceSelector &s)
{
  std::string words;
  if (s.plane)
    words += "plane = { normal = " + toml(s.plane->normal) + ", through = " + toml(s.plane->through) + " }\n";
  if (s.cylinder)
    words += "cylinder = { axis = " + toml(s.cylinder->axis) + ", through = " + toml(s.cylinder->through) +
             ", radius = " + toml(s.cylinder->radius) + " }\n";
  if (s.box)
    words += "box = { min = " + toml(s.box->min) + ", max = " + toml(s.box->max) + " }\n";
  if (s.group)
    words += "group = " + toml(*s.group) + "\n";
  if (s.tolerance)
    words += "tolerance = " + toml(*s.tolerance) + "\n";
  if (s.faces != 1)
    words += "faces = " + std::to_string(s.faces) + "\n";
  return words;
}

/// Selector of the surface of the face, through one of its points; empty for faces of other kinds.
SurfaceSelector by_surface(const fem::Face &face, const Vector3 &through)
{
  SurfaceSelector selector;
  if (face.kind == fem::FaceKind::plane)
    selector.plane = {rounded_off(face.direction), rounded_off(through)};
  if (face.kind == fem::FaceKind::cylinder)
    selector.cylinder = {rounded_off(face.direction), rounded_off(through), rounded_off(face.radius)};
  return selector;
}

/// A box half a tolerance wider than the face, so that the face does not lie at the limit of the tolerance.
SurfaceSelector::Box box_of(const fem::Face &face, double tolerance)
{
  SurfaceSelector::Box box;
  for (int d = 0; d < 3; ++d)
  {
    box.min[d] = rounded_off(face.min[d] - 0.5 * tolerance);
    box.max[d] = rounded_off(face.max[d] + 0.5 * tolerance);
  }
  return box;
}

/// Points to describe a plane or an axis: the corners of the face's box, projected onto it.
std::vector<Vector3> places_of(const fem::Face &face)
{
  std::vector<Vector3> places;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3 x{corner & 1 ? face.max[0] : face.min[0], corner & 2 ? face.max[1] : face.min[1],
                    corner & 4 ? face.max[2] : face.min[2]};
    const double way = fem::dot(x - face.through, face.direction);
    places.push_back(face.kind == fem::FaceKind::plane ? x - way * face.direction
                                                       : face.through + way * face.direction);
  }
  return places;
}

/// Selectors of the face, from the simplest to the most specific.
std::vector<SurfaceSelector> candidates(const fem::Face &face, double tolerance)
{
  std::vector<SurfaceSelector> list;
  const auto                   with_box = [&](SurfaceSelector selector)
  {
    selector.box = box_of(face, tolerance);
    list.push_back(selector);
  };
  if (face.kind != fem::FaceKind::other)
  {
    list.push_back(by_surface(face, face.through));
    with_box(list.back());
    for (const Vector3 &place : places_of(face))
      with_box(by_surface(face, place));
  }
  with_box({});
  std::vector<std::string> names = face.groups;
  if (!face.name.empty())
    names.push_back(face.name);
  for (const std::string &name : names)
  {
    SurfaceSelector selector = by_surface(face, face.through);
    selector.group           = name;
    list.push_back(selector);
    with_box(selector);
  }
  return list;
}

/// Faces that the selector finds; none if their number is not the one that it requires.
std::vector<int> found_by(const SurfaceSelector &selector, const std::vector<fem::Face> &faces, double diagonal)
{
  try
  {
    return fem::select_faces(faces, selector, diagonal);
  }
  catch (const std::invalid_argument &)
  {
    return {};
  }
}

} // namespace

std::vector<FaceGroup> bores_of(const fem::Face &face, const std::vector<fem::Face> &faces, double diagonal)
{
  if (face.kind != fem::FaceKind::cylinder)
    return {};
  const Vector3   middle = 0.5 * (face.min + face.max);
  SurfaceSelector selector =
      by_surface(face, face.through + fem::dot(middle - face.through, face.direction) * face.direction);
  std::vector<FaceGroup> groups;
  const auto             add = [&](const std::string &name, const std::vector<int> &found)
  {
    const bool larger = found.size() > (groups.empty() ? 1 : groups.back().faces.size());
    if (larger && std::binary_search(found.begin(), found.end(), face.tag))
      groups.push_back({name, found, toml(selector)});
  };
  add("this bore", found_by(selector, faces, diagonal));
  selector.faces             = 0;
  const std::vector<int> all = found_by(selector, faces, diagonal);
  for (int n = static_cast<int>(all.size()); n > 1; --n) // the least number that selects them: of bores, not of faces
    if (SurfaceSelector counted = selector; counted.faces = n, found_by(counted, faces, diagonal) == all)
      selector = counted;
  if (selector.faces > 1)
    add("the coaxial bores of this radius", all);
  return groups;
}

FaceSelector selector_of(const fem::Face &face, const std::vector<fem::Face> &faces, double diagonal)
{
  constexpr double by_default = 1e-4; // tolerance of selectors, of the model's diagonal
  for (const double tolerance : {by_default, 1e-5, 1e-6})
    for (SurfaceSelector selector : candidates(face, tolerance * diagonal))
    {
      if (tolerance < by_default)
        selector.tolerance = rounded_off(tolerance * diagonal);
      if (selector.tolerance != 0. && found_by(selector, faces, diagonal) == std::vector<int>{face.tag})
        return {toml(selector), {}};
    }

  SurfaceSelector widest = by_surface(face, face.through);
  widest.box             = box_of(face, by_default * diagonal);
  widest.faces           = 0;
  std::vector<int> found = found_by(widest, faces, diagonal);
  widest.faces           = static_cast<int>(found.size());
  std::vector<int> others;
  for (const int tag : found)
    if (tag != face.tag)
      others.push_back(tag);
  return {toml(widest), others};
}

} // namespace gestell::coupling

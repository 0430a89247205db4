#include "fem/geometry/surface_selection.h"

#include "fem/values/vector3.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace gestell::fem
{

namespace
{

constexpr double      never            = std::numeric_limits<double>::infinity();
constexpr std::size_t candidates_shown = 8; ///< lines of a message: a screen has some more

double extent(const Face &face)
{
  return norm(face.max - face.min);
}

/// Distance of a point from the axis through p in the unit direction a.
double axis_distance(const Vector3 &point, const Vector3 &p, const Vector3 &a)
{
  return norm(cross(point - p, a));
}

/// How far [m] the face is from lying on the plane; infinite if it looks the other way.
double violation(const Face &face, const SurfaceSelector::Plane &plane)
{
  const Vector3 n     = unit(plane.normal);
  double        worst = 0.;
  for (const auto &[point, normal] : face.samples)
  {
    if (dot(normal, n) <= 0.)
      return never;
    const double tilt = norm(cross(normal, n));
    worst = std::max({worst, std::abs(dot(point - plane.through, n)), tilt > straight ? tilt * extent(face) : 0.});
  }
  return worst;
}

/// Distance [m] of the face from the cylinder; infinite if it is perpendicular to the axis.
double violation(const Face &face, const SurfaceSelector::Cylinder &cylinder)
{
  const Vector3 a     = unit(cylinder.axis);
  double        worst = 0.;
  for (const auto &[point, normal] : face.samples)
  {
    const double tilt = std::abs(dot(normal, a));
    if (tilt > 0.5) // also excludes a disc whose few points all lie on its rim
      return never;
    const bool tilted = !face.faceted && tilt > straight;
    worst             = std::max({worst, std::abs(axis_distance(point, cylinder.through, a) - cylinder.radius),
                      tilted ? tilt * extent(face) : 0.});
  }
  return worst;
}

/// How far [m] the face sticks out of the box.
double violation(const Face &face, const SurfaceSelector::Box &box)
{
  double worst = 0.;
  for (int d = 0; d < 3; ++d)
    worst = std::max({worst, box.min[d] - face.min[d], face.max[d] - box.max[d]});
  return worst;
}

double violation(const Face &face, const std::string &group)
{
  const std::string last = face.name.substr(face.name.rfind('/') + 1); // npos + 1 = 0: the whole name
  const bool        in   = std::find(face.groups.begin(), face.groups.end(), group) != face.groups.end();
  return in || (!group.empty() && (face.name == group || last == group)) ? 0. : never;
}

double violation(const Face &face, const SurfaceSelector &selector)
{
  double worst = 0.;
  if (selector.plane)
    worst = std::max(worst, violation(face, *selector.plane));
  if (selector.cylinder)
    worst = std::max(worst, violation(face, *selector.cylinder));
  if (selector.box)
    worst = std::max(worst, violation(face, *selector.box));
  if (selector.group)
    worst = std::max(worst, violation(face, *selector.group));
  return worst;
}

/// Does the point lie within the extent of the face, measured along the axis or within the plane?
bool holds(const Face &face, const SurfaceSelector &selector, double tolerance)
{
  const auto &[min, max] = std::pair(face.min, face.max);
  if (selector.plane)
  {
    const Vector3 &p = selector.plane->through;
    for (int d = 0; d < 3; ++d)
      if (p[d] < min[d] - tolerance || p[d] > max[d] + tolerance)
        return false;
  }
  if (selector.cylinder)
  {
    const Vector3 a   = unit(selector.cylinder->axis);
    double        low = never, high = -never;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vector3 p{corner & 1 ? max[0] : min[0], corner & 2 ? max[1] : min[1], corner & 4 ? max[2] : min[2]};
      low  = std::min(low, dot(p, a));
      high = std::max(high, dot(p, a));
    }
    const double at = dot(selector.cylinder->through, a);
    if (at < low - tolerance || at > high + tolerance)
      return false;
  }
  return true;
}

void check(const SurfaceSelector &selector)
{
  const auto refuse = [&](const std::string &why) { throw std::invalid_argument(selector.place + ": " + why); };
  if (!selector.plane && !selector.cylinder && !selector.box && !selector.group)
    refuse("no condition given; select the surface by plane, cylinder, box or group");
  if (selector.plane && !(norm(selector.plane->normal) > 0.))
    refuse("plane.normal is zero; give the outward normal, such as [0, 0, 1]");
  if (selector.cylinder && !(norm(selector.cylinder->axis) > 0.))
    refuse("cylinder.axis is zero; give its direction, such as [0, 1, 0]");
  if (selector.cylinder && !(selector.cylinder->radius > 0.))
    refuse("cylinder.radius = " + text(selector.cylinder->radius) + " m; it must be > 0");
  if (selector.tolerance && !(*selector.tolerance > 0.))
    refuse("tolerance = " + text(*selector.tolerance) + " m; it must be > 0");
  if (selector.faces < 0)
    refuse("faces = " + std::to_string(selector.faces) + "; give the number of CAD faces, or 0 for any number");
}

std::string wish(const SurfaceSelector &selector)
{
  std::string words;
  if (selector.plane)
    words +=
        ", plane with outward normal " + text(selector.plane->normal) + " through " + text(selector.plane->through);
  if (selector.cylinder)
    words += ", cylinder of radius " + text(selector.cylinder->radius) + " m about the axis " +
             text(selector.cylinder->axis) + " through " + text(selector.cylinder->through);
  if (selector.box)
    words += ", in the box " + text(selector.box->min) + " to " + text(selector.box->max);
  if (selector.group)
    words += ", group \"" + *selector.group + "\"";
  return words.substr(2);
}

/// The nearest faces, best first; if none is near, faces of the wanted kind first.
std::string candidates(const std::vector<Face> &faces, const SurfaceSelector &selector)
{
  const auto kind_fits = [&](const Face &face)
  {
    return (!selector.plane || face.kind == FaceKind::plane) && (!selector.cylinder || face.kind == FaceKind::cylinder);
  };
  const auto rank = [&](const Face &face) { return std::pair(violation(face, selector), kind_fits(face) ? 0 : 1); };
  std::vector<const Face *> sorted;
  for (const Face &face : faces)
    sorted.push_back(&face);
  std::stable_sort(sorted.begin(), sorted.end(), [&](auto *a, auto *b) { return rank(*a) < rank(*b); });

  std::string lines;
  for (std::size_t i = 0; i < std::min(sorted.size(), candidates_shown); ++i)
  {
    const double off = violation(*sorted[i], selector);
    lines += "\n  " + describe(*sorted[i]) + (off == never ? "" : ", off by " + text(off * 1e3) + " mm");
  }
  if (sorted.size() > candidates_shown)
    lines += "\n  and " + std::to_string(sorted.size() - candidates_shown) + " more: see `gestell mesh`";
  return lines;
}

std::string groups_of(const std::vector<Face> &faces)
{
  std::vector<std::string> names;
  for (const Face &face : faces)
  {
    names.insert(names.end(), face.groups.begin(), face.groups.end());
    if (!face.name.empty())
      names.push_back(face.name);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::string list;
  for (const std::string &name : names)
    list += (list.empty() ? "\"" : ", \"") + name + "\"";
  return list.empty() ? "The model has no named group or face." : "The model names " + list + ".";
}

/// Number of the connected piece of each face; faces that share an edge are connected, as the halves of a bore.
std::vector<std::size_t> pieces_of(const std::vector<const Face *> &faces)
{
  std::vector<std::size_t>   piece(faces.size());
  std::map<int, std::size_t> first_at; // edge to face
  for (std::size_t i = 0; i < faces.size(); ++i)
  {
    piece[i] = i;
    for (const int edge : faces[i]->edges)
      if (const auto [other, is_new] = first_at.try_emplace(edge, i); !is_new)
        std::replace(piece.begin(), piece.end(), piece[i], piece[other->second]);
  }
  return piece;
}

std::size_t n_pieces(const std::vector<const Face *> &faces)
{
  const std::vector<std::size_t> piece = pieces_of(faces);
  return std::set<std::size_t>(piece.begin(), piece.end()).size();
}

/// Whether the number of faces, or of their connected pieces, is `wanted`.
bool are_as_many(const std::vector<const Face *> &faces, std::size_t wanted)
{
  return faces.size() == wanted || n_pieces(faces) == wanted;
}

/// The whole pieces that contain a face at the point of the selector.
std::vector<const Face *> pieces_at(const std::vector<const Face *> &faces, const SurfaceSelector &selector,
                                    double tolerance)
{
  const std::vector<std::size_t> piece = pieces_of(faces);
  std::set<std::size_t>          here;
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (holds(*faces[i], selector, tolerance))
      here.insert(piece[i]);
  std::vector<const Face *> result;
  for (std::size_t i = 0; i < faces.size(); ++i)
    if (here.count(piece[i]) > 0)
      result.push_back(faces[i]);
  return result;
}

/// Refuses a number that fits both the faces at the point of the selector and all matching pieces.
[[noreturn]] void refuse_two_meanings(const SurfaceSelector &selector, const std::vector<const Face *> &here,
                                      const std::vector<const Face *> &all)
{
  const auto of = [](const std::vector<const Face *> &faces)
  { return std::to_string(n_pieces(faces)) + (n_pieces(faces) == 1 ? " piece" : " pieces"); };
  throw std::invalid_argument(selector.place + ": faces = " + std::to_string(selector.faces) +
                              " is ambiguous: it may be the " + std::to_string(here.size()) +
                              " faces at 'through', which form " + of(here) + ", or " + of(all) + " of " +
                              std::to_string(all.size()) + " faces; write faces = " + std::to_string(n_pieces(here)) +
                              " for the former, faces = " + std::to_string(all.size()) + " for the latter.");
}

/// Faces the box cuts through, though they meet all other conditions.
std::string cut_by_box(const std::vector<Face> &faces, const SurfaceSelector &selector, double tolerance)
{
  if (!selector.box)
    return "";
  SurfaceSelector others = selector;
  others.box.reset();
  const auto inside = [&](const Face::Sample &sample)
  {
    for (int d = 0; d < 3; ++d)
      if (sample.point[d] < selector.box->min[d] - tolerance || sample.point[d] > selector.box->max[d] + tolerance)
        return false;
    return true;
  };
  std::string list;
  for (const Face &face : faces)
    if (violation(face, others) <= tolerance && violation(face, *selector.box) > tolerance)
      if (const auto n = std::count_if(face.samples.begin(), face.samples.end(), inside); n > 0)
        list += (list.empty() ? " " : ", ") + std::to_string(face.tag);
  return list.empty() ? ""
                      : " The box cuts through face" + list +
                            ": selectors take whole faces; enlarge the box, or split the face in the CAD program.";
}

} // namespace

std::vector<int> select_faces(const std::vector<Face> &faces, const SurfaceSelector &selector, double diagonal)
{
  check(selector);
  const double              tolerance = selector.tolerance.value_or(1e-4 * diagonal);
  std::vector<const Face *> fitting;
  for (const Face &face : faces)
    if (violation(face, selector) <= tolerance)
      fitting.push_back(&face);

  const std::size_t wanted = selector.faces;
  if (wanted > 0 && fitting.size() > wanted)
    if (const std::vector<const Face *> here = pieces_at(fitting, selector, tolerance);
        here.size() < fitting.size() && are_as_many(here, wanted))
    {
      if (are_as_many(fitting, wanted))
        refuse_two_meanings(selector, here, fitting);
      fitting = here;
    }

  if (fitting.empty())
    throw std::invalid_argument(selector.place + ": no face matches (" + wish(selector) + ") within " +
                                text(tolerance * 1e3) + " mm." + (selector.group ? " " + groups_of(faces) : "") +
                                cut_by_box(faces, selector, tolerance) +
                                " Nearest faces, lengths in m:" + candidates(faces, selector));
  if (wanted > 0 && !are_as_many(fitting, wanted))
    throw std::invalid_argument(
        selector.place + ": " + std::to_string(fitting.size()) + " faces match (" + wish(selector) +
        "), but faces = " + std::to_string(wanted) +
        "; let 'through' be within the intended faces, narrow the selection by a box, or set faces." +
        cut_by_box(faces, selector, tolerance) + " Candidates, lengths in m:" + candidates(faces, selector));
  std::vector<int> tags;
  for (const Face *face : fitting)
    tags.push_back(face->tag);
  std::sort(tags.begin(), tags.end());
  return tags;
}

std::string coaxial_faces(const std::vector<Face> &faces, const SurfaceSelector &selector,
                          const std::vector<int> &selected, double diagonal)
{
  if (!selector.cylinder)
    return "";
  const double              tolerance = selector.tolerance.value_or(1e-4 * diagonal);
  SurfaceSelector::Cylinder any       = *selector.cylinder;
  std::vector<std::string>  left;
  for (const Face &face : faces)
  {
    any.radius = face.radius;
    if (face.kind == FaceKind::cylinder && !std::binary_search(selected.begin(), selected.end(), face.tag) &&
        violation(face, any) <= tolerance)
      left.push_back(std::to_string(face.tag) + " (radius " + text(face.radius) + " m)");
  }
  if (left.empty() && selected.size() == 1)
    return "";
  std::string words = selected.size() == 1 ? "face" : "faces";
  for (const int tag : selected)
    words += (tag == selected.front() ? " " : ", ") + std::to_string(tag);
  for (std::size_t i = 0; i < std::min(left.size(), candidates_shown); ++i)
    words += (i == 0 ? "; coaxial faces not selected: " : ", ") + left[i];
  if (left.size() > candidates_shown)
    words += " and " + std::to_string(left.size() - candidates_shown) + " more";
  return words;
}

} // namespace gestell::fem

#include "coupling/plugin/frame/make_mesh_report.h"

#include "coupling/plugin/frame/face_selector.h"
#include "coupling/plugin/mesh_report.h"
#include "fem/geometry/cad_file.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/mesher.h"
#include "fem/values/frame_specification.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <utility>

namespace gestell::coupling
{

namespace
{

const std::pair<const char *, double> prefixes[]    = {{".MICRO.", 1e-6}, {".MILLI.", 1e-3}, {".CENTI.", 1e-2},
                                                       {".DECI.", 1e-1},  {".KILO.", 1e3},   {"", 1.}};
const std::pair<const char *, double> conversions[] = {{"INCH", 0.0254}, {"FOOT", 0.3048}, {"FEET", 0.3048}, {"", 1.}};
const std::pair<const char *, double> names[]       = {{"mm", 1e-3}, {"cm", 1e-2},     {"m", 1.},
                                                       {"µm", 1e-6}, {"inch", 0.0254}, {"foot", 0.3048}};

template <std::size_t n>
double first_in(const std::string &text, const std::pair<const char *, double> (&words)[n])
{
  for (const auto &[word, value] : words)
    if (text.find(word) != std::string::npos)
      return value;
  return 1.;
}

std::string upper(std::string text)
{
  for (char &c : text)
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

/// Unit of length of a STEP file [m]: the last entity with LENGTH_UNIT that is not inside a conversion. `(
/// CONVERSION_BASED_UNIT('INCH', #5) LENGTH_UNIT() ... )` refers to metres, which have an entity of their own.
double length_in_step(const std::string &path)
{
  std::ifstream     in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  double            length = 1e-3;
  for (std::size_t at = text.find("LENGTH_UNIT"); at != std::string::npos; at = text.find("LENGTH_UNIT", at + 1))
  {
    const std::size_t begin = text.rfind(';', at) + 1, end = text.find(';', at);
    const std::string entity = upper(text.substr(begin, end - begin));
    if (entity.find("CONVERSION_BASED_UNIT") != std::string::npos)
      return first_in(entity, conversions);
    if (entity.find("SI_UNIT") != std::string::npos)
      length = first_in(entity, prefixes);
  }
  return length;
}

/// The unit of length of a frame's file: for STEP files the unit in the file, for other files the unit of the
/// specification or the metre.
LengthUnit file_unit(const fem::FrameSpecification &frame)
{
  double length = frame.unit > 0. ? frame.unit : 1.;
  if (fem::is_step(frame.cad)) // a given unit is the length of the file's millimetre
    length = length_in_step(frame.cad) * (frame.unit > 0. ? frame.unit / 1e-3 : 1.);
  for (const auto &[name, value] : names)
    if (std::abs(length - value) < 1e-9 * value)
      return {value, name};
  return {length, "x " + short_text(length) + " m"};
}

/// Names a face bears: in the file, its groups, then those the specification gives it.
std::string names_of(const fem::Face &face, const std::map<std::string, std::vector<int>> &surfaces)
{
  std::string names = face.name;
  const auto  add   = [&](const std::string &name) { names += (names.empty() ? "" : ", ") + name; };
  for (const std::string &group : face.groups)
    add(group);
  for (const auto &[name, tags] : surfaces)
    if (std::find(tags.begin(), tags.end(), face.tag) != tags.end())
      add(name);
  return names;
}

/// The face as a selector would find it.
std::string shape_of(const fem::Face &face)
{
  switch (face.kind)
  {
  case fem::FaceKind::plane:
    return "plane, normal " + fem::text(face.direction) + ", through " + fem::text(face.through);
  case fem::FaceKind::cylinder:
    return "cylinder, axis " + fem::text(face.direction) + ", through " + fem::text(face.through) + ", radius " +
           fem::text(face.radius);
  case fem::FaceKind::other:
    break;
  }
  return face.type;
}

std::vector<std::string> features_of(const fem::GeometryReport &geometry)
{
  std::vector<std::string> lines;
  if (!geometry.smallest.empty())
    lines.push_back(geometry.smallest);
  if (const fem::WallThickness &walls = geometry.walls; walls.thin_share > 0.)
    lines.push_back(
        fem::text(std::round(100. * walls.thin_share)) +
        " % of the surface is on walls thinner than the elements, down to " + fem::text(1e3 * walls.thinnest) +
        " mm; there elements are " + fem::text(walls.median_ratio) + " times as large as the wall thickness (median)" +
        (walls.median_ratio > 2. && geometry.n_of_kind[0] > 0 ? ": bending is too stiff, see gestell modes --converge"
                                                              : ""));
  return lines;
}

/// "tetrahedra", or of several kinds "cells (12 tetrahedra, 8 prisms)".
std::string kinds_of(const fem::GeometryReport &geometry)
{
  const std::array<std::string, 3> names = {"tetrahedra", "hexahedra", "prisms"};
  std::string                      counts, last;
  int                              n = 0;
  for (std::size_t kind = 0; kind < names.size(); ++kind)
    if (geometry.n_of_kind[kind] > 0)
    {
      counts += (n++ > 0 ? ", " : "") + std::to_string(geometry.n_of_kind[kind]) + " " + names[kind];
      last = names[kind];
    }
  return n == 1 ? last : "cells (" + counts + ")";
}

std::string kind_of(const fem::Face &face)
{
  return face.kind == fem::FaceKind::plane ? "plane" : face.kind == fem::FaceKind::cylinder ? "cylinder" : face.type;
}

/// Triangles of no face, between gmsh's surfaces, are left out.
FacePicture picture_of(const fem::GeometryReport &geometry)
{
  std::map<int, int> index;
  for (std::size_t i = 0; i < geometry.faces.size(); ++i)
    index[geometry.faces[i].tag] = static_cast<int>(i);
  const fem::Mesh &mesh = geometry.extracted.mesh;
  FacePicture      picture;
  std::vector<int> number(mesh.points.size(), -1);
  for (std::size_t t = 0; t < mesh.skin.size(); ++t)
  {
    const auto face = index.find(geometry.extracted.skin_surface[t]);
    if (face == index.end())
      continue;
    picture.face.push_back(face->second);
    picture.triangles.emplace_back();
    for (int k = 0; k < 3; ++k)
    {
      int &point = number[mesh.skin[t][k]];
      if (point < 0)
      {
        point = static_cast<int>(picture.points.size());
        picture.points.push_back(mesh.points[mesh.skin[t][k]]);
      }
      picture.triangles.back()[k] = point;
    }
  }
  return picture;
}

} // namespace

MeshReport mesh_report(const fem::FrameSpecification &frame, const Progress &progress)
{
  const fem::GeometryReport geometry = fem::report_geometry(frame, progress);
  MeshReport                report;
  report.n_points       = geometry.n_points;
  report.n_cells        = geometry.n_cells;
  report.n_coordinates  = geometry.n_coordinates;
  report.cells          = kinds_of(geometry);
  report.size           = geometry.size;
  report.volume         = geometry.volume;
  report.worst_quality  = geometry.worst_quality;
  report.mean_quality   = geometry.mean_quality;
  report.expected_cells = geometry.expected_cells;
  report.memory =
      fem::reduction_memory(geometry.n_coordinates, fem::compactness(geometry.volume, fem::skin_area(geometry.faces)));
  report.available_memory = fem::available_memory();
  report.features         = features_of(geometry);
  report.notes            = geometry.notes;
  report.statements       = geometry.statements;
  constexpr double steel  = 7850.; // [kg/m^3] of structures; what is not steel is given
  double           mass = 0., volume = 0.;
  for (const auto &solid : geometry.solids)
  {
    const double density = frame.material.rho > 0. ? frame.material.rho : solid.density > 0. ? solid.density : steel;
    report.solids.push_back(
        {solid.name, solid.volume, solid.volume * density, solid.min, solid.max, density, solid.material});
    mass += density * solid.volume;
    volume += solid.volume;
  }
  report.mass     = volume > 0. ? mass / volume * geometry.volume : 0.;
  double diagonal = 0.;
  for (int d = 0; d < 3; ++d)
    diagonal = std::hypot(diagonal, geometry.max[d] - geometry.min[d]);
  for (const auto &face : geometry.faces)
  {
    const FaceSelector own = selector_of(face, geometry.faces, diagonal);
    report.surfaces.push_back({face.tag, names_of(face, geometry.surfaces), shape_of(face), own.text, face.area,
                               face.min, face.max, face.centre, own.others, kind_of(face), face.direction, face.through,
                               face.radius, bores_of(face, geometry.faces, diagonal)});
  }
  report.picture = picture_of(geometry);
  report.unit    = file_unit(frame);
  return report;
}

} // namespace gestell::coupling

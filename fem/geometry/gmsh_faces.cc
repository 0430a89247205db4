#include "fem/geometry/gmsh_faces.h"

#include "fem/values/vector3.h"

#include <gmsh.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace gestell::fem
{

namespace
{

/// Names of all solids: a face without a name of its own gets its solid's from OpenCASCADE.
std::set<std::string> names_of_solids()
{
  gmsh::vectorpair solids;
  gmsh::model::getEntities(solids, 3);
  std::set<std::string> names;
  for (const auto &[dim, tag] : solids)
  {
    std::string name;
    gmsh::model::getEntityName(dim, tag, name);
    names.insert(name_in_label(name));
  }
  return names;
}

/// @param no_names  what is written where a face has no name
void read_names(Face &face, const std::set<std::string> &no_names)
{
  gmsh::model::getType(2, face.tag, face.type);
  gmsh::model::getEntityName(2, face.tag, face.name);
  if (no_names.count(name_in_label(face.name)) > 0)
    face.name.clear();
  std::vector<int> groups;
  gmsh::model::getPhysicalGroupsForEntity(2, face.tag, groups);
  for (const int group : groups)
  {
    std::string name;
    gmsh::model::getPhysicalName(2, group, name);
    face.groups.push_back(name.empty() ? std::to_string(group) : name);
  }
}

/// Points and outward normals on a grid in the parameters of the surface, inside its bounds.
std::vector<Face::Sample> sample(int tag, double unit)
{
  std::vector<double> low, high, parameters, points, normals;
  gmsh::model::getParametrizationBounds(2, tag, low, high);
  constexpr int samples_per_direction = 5; // 25 points of a face; 6 determine a cone
  for (int i = 0; i < samples_per_direction; ++i)
    for (int j = 0; j < samples_per_direction; ++j)
    {
      parameters.push_back(low[0] + (high[0] - low[0]) * (i + 0.5) / samples_per_direction);
      parameters.push_back(low[1] + (high[1] - low[1]) * (j + 0.5) / samples_per_direction);
    }
  gmsh::model::getValue(2, tag, parameters, points);
  gmsh::model::getNormal(tag, parameters, normals);
  std::vector<Face::Sample> samples;
  for (std::size_t i = 0; i + 2 < points.size(); i += 3)
    samples.push_back(
        {unit * Vector3{points[i], points[i + 1], points[i + 2]}, Vector3{normals[i], normals[i + 1], normals[i + 2]}});
  return samples;
}

Face face_of_geometry(int tag, double unit, const std::set<std::string> &no_names)
{
  Face face;
  face.tag = tag;
  read_names(face, no_names);
  auto &[x0, y0, z0] = face.min;
  auto &[x1, y1, z1] = face.max;
  gmsh::model::getBoundingBox(2, tag, x0, y0, z0, x1, y1, z1);
  face.min = unit * face.min;
  face.max = unit * face.max;
  gmsh::model::occ::getMass(2, tag, face.area);
  face.area *= unit * unit;
  auto &[x, y, z] = face.centre;
  gmsh::model::occ::getCenterOfMass(2, tag, x, y, z);
  face.centre  = unit * face.centre;
  face.samples = sample(tag, unit);
  return face;
}

/// Adds a triangle to a face; `centre` is a sum over the area until faces_of_skin() divides it.
void add_triangle(Face &face, const Vector3 &a, const Vector3 &b, const Vector3 &c)
{
  const Vector3 twice_area = cross(b - a, c - a);
  const double  area       = 0.5 * norm(twice_area);
  const Vector3 normal     = unit(twice_area);
  for (const Vector3 &point : {a, b, c})
  {
    face.samples.push_back({point, normal});
    for (int d = 0; d < 3; ++d)
    {
      face.min[d] = std::min(face.min[d], point[d]);
      face.max[d] = std::max(face.max[d], point[d]);
    }
  }
  face.area += area;
  face.centre = face.centre + (area / 3.) * (a + b + c);
}

/// Numbers the edges of the mesh between two faces, so that adjacent faces can be found.
void find_neighbours(std::map<int, Face> &faces, const Mesh &mesh, const std::vector<int> &skin_surface)
{
  std::map<std::pair<int, int>, std::set<int>> around; // edge to tags of faces
  for (std::size_t t = 0; t < mesh.skin.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (skin_surface[t] != 0)
        around[std::minmax(mesh.skin[t][k], mesh.skin[t][(k + 1) % 3])].insert(skin_surface[t]);
  int n = 0;
  for (const auto &[edge, tags] : around)
    if (tags.size() > 1)
    {
      ++n;
      for (const int tag : tags)
        faces.at(tag).edges.push_back(n);
    }
}

/// The faces that bound the given number of solids.
std::vector<Face> faces_of_geometry(std::size_t n_solids, double unit, double diagonal)
{
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, 2);
  std::set<std::string> no_names = names_of_solids();
  no_names.insert("NONE"); // as some CAD programs write
  std::vector<Face> faces;
  for (const auto &[dim, tag] : entities)
  {
    std::vector<int> solids, curves;
    gmsh::model::getAdjacencies(2, tag, solids, curves);
    if (solids.size() != n_solids)
      continue;
    faces.push_back(face_of_geometry(tag, unit, no_names));
    faces.back().edges                  = curves;
    constexpr double relative_tolerance = 1e-6; // of the model: CAD programs agree on points to about 1e-7 of it
    recognise(faces.back(), relative_tolerance * diagonal);
  }
  return faces;
}

} // namespace

std::string name_in_label(const std::string &label)
{
  return label.substr(label.rfind('/') + 1);
}

std::vector<Face> outer_faces(double unit, double diagonal)
{
  return faces_of_geometry(1, unit, diagonal);
}

std::vector<Face> inner_faces(double unit, double diagonal)
{
  return faces_of_geometry(2, unit, diagonal);
}

std::vector<Face> faces_of_skin(const Mesh &mesh, const std::vector<int> &skin_surface,
                                const std::map<int, std::vector<std::string>> &divided)
{
  std::map<int, Face> faces;
  for (std::size_t t = 0; t < mesh.skin.size(); ++t)
  {
    const auto &[a, b, c] = mesh.skin[t];
    if (skin_surface[t] == 0)
      continue;
    auto [entry, is_new] = faces.try_emplace(skin_surface[t]);
    Face &face           = entry->second;
    if (is_new)
      face.min = face.max = mesh.points[a];
    add_triangle(face, mesh.points[a], mesh.points[b], mesh.points[c]);
  }
  find_neighbours(faces, mesh, skin_surface);

  std::vector<Face> list;
  for (auto &[tag, face] : faces)
  {
    face.tag     = tag;
    face.faceted = true;
    face.centre  = (1. / face.area) * face.centre;
    if (const auto own = divided.find(tag); own != divided.end())
    {
      face.type   = "Discrete surface";
      face.groups = own->second;
    }
    else
      read_names(face, {});
    constexpr double facet_tolerance = 1e-5; // of a face of a mesh: files have six or seven digits
    recognise(face, facet_tolerance * norm(face.max - face.min));
    list.push_back(std::move(face));
  }
  return list;
}

} // namespace gestell::fem

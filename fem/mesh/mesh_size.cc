#include "fem/mesh/mesh_size.h"

#include <fnmatch.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

constexpr double cells_per_volume = 10.; // measured: 9 to 10.5 for blocks and for welded plates
constexpr double cells_per_area   = 4.5; // measured on plates thinner than the size

double area_of(const CadModel &model, const std::vector<int> &tags)
{
  double area = 0.;
  for (const Face &face : model.faces)
    if (std::find(tags.begin(), tags.end(), face.tag) != tags.end())
      area += face.area;
  return area;
}

double round_up_to_two_digits(double value)
{
  const double unit = std::pow(10., std::floor(std::log10(value)) - 1.);
  return std::ceil(value / unit - 1e-9) * unit;
}

void check_size(const CadModel &model, const MeshOptions &options)
{
  const auto   refuse = [&](const std::string &why) { throw std::invalid_argument(options.place + ": " + why); };
  const double largest =
      std::max({model.max[0] - model.min[0], model.max[1] - model.min[1], model.max[2] - model.min[2]});
  const double      likely = size_for_cells(model, 25000.);
  const std::string advice = "; size = " + text(likely) + " m would give about 25000 tetrahedra.";
  if (!(options.size > 0.))
    refuse("size = " + text(options.size) + " m; the element size must be > 0" + advice);
  if (options.size > largest)
    refuse("size = " + text(options.size) + " m is larger than the model (" + text(largest) + " m)" + advice);
}

void check_surface_sizes(const MeshOptions &options, const Selection &selection)
{
  const auto refuse = [&](const std::string &why) { throw std::invalid_argument(options.place + ": " + why); };
  for (const auto &[pattern, size] : options.surface_size)
  {
    const bool  known = std::any_of(selection.begin(), selection.end(),
                                    [&, &pattern = pattern](const auto &surface)
                                    { return fnmatch(pattern.c_str(), surface.first.c_str(), 0) == 0; });
    std::string names;
    for (const auto &surface : selection)
      names += (names.empty() ? "\"" : ", \"") + surface.first + "\"";
    if (!known)
      refuse("\"" + pattern + "\" = " + text(size) + " m: there is no such surface; known are " +
             (names.empty() ? "none" : names) + ".");
    if (!(size > 0.) || size > options.size)
      refuse("\"" + pattern + "\" = " + text(size) +
             " m; the size on a surface must be > 0 and at most size = " + text(options.size) + " m.");
  }
}

void check_number_of_cells(const CadModel &model, const MeshOptions &options,
                           const std::map<std::string, double> &surface_size, const Selection &selection)
{
  const double all = expected_cells(model, options.size, surface_size, selection);
  if (all <= options.max_cells)
    return;
  const double      global = expected_cells(model, options.size, {}, {});
  const std::string found  = "size = " + text(options.size) + " m would give about " + text(all) +
                            " tetrahedra, mesh.max_cells allows " + text(options.max_cells);
  if (global <= options.max_cells)
    throw std::invalid_argument(options.place + ": " + found + "; most of them are due to the sizes on surfaces (" +
                                text(global) + " without): enlarge those, or increase max_cells.");
  throw std::invalid_argument(options.place + ": " + found +
                              "; use size = " + text(size_for_cells(model, options.max_cells)) +
                              " m or more, or increase max_cells. The model is " + text(model.diagonal()) +
                              " m across, " + text(model.volume()) + " m^3: if that is wrong, its unit is wrong.");
}

/// A field that is s on the faces and grows to h with the distance d:  min(h, s + growth d).
int add_field(const std::vector<int> &tags, double s, double h)
{
  namespace field = gmsh::model::mesh::field;
  std::vector<double> faces(tags.begin(), tags.end()), curves;
  gmsh::vectorpair    entities, boundary;
  for (const int tag : tags)
    entities.emplace_back(2, tag);
  gmsh::model::getBoundary(entities, boundary, false, false, false);
  for (const auto &[dim, tag] : boundary)
    curves.push_back(tag);

  const int distance = field::add("Distance");
  field::setNumbers(distance, "FacesList", faces);
  field::setNumbers(distance, "EdgesList", curves);
  field::setNumber(distance, "NNodesByEdge", 50);
  const int threshold = field::add("Threshold");
  field::setNumber(threshold, "InField", distance);
  field::setNumber(threshold, "SizeMin", s);
  field::setNumber(threshold, "SizeMax", h);
  field::setNumber(threshold, "DistMin", 0.5 * s); // distance of the points that represent the face
  field::setNumber(threshold, "DistMax", 0.5 * s + std::max(h - s, 1e-9 * h) / size_growth);
  return threshold;
}

} // namespace

double skin_area(const std::vector<Face> &faces)
{
  return std::accumulate(faces.begin(), faces.end(), 0., [](double sum, const Face &face) { return sum + face.area; });
}

double expected_cells(const CadModel &model, double size, const std::map<std::string, double> &surface_size,
                      const Selection &selection)
{
  const double V = model.volume();
  double       n =
      std::max(cells_per_volume * V / std::pow(size, 3), cells_per_area * skin_area(model.faces) / (size * size));
  for (const auto &[name, s] : surface_size)
    n += std::min(cells_per_volume * area_of(model, selection.at(name)) / (2. * size_growth * s * s),
                  cells_per_volume * V / std::pow(s, 3));
  return n;
}

double size_for_cells(const CadModel &model, double n_cells)
{
  return round_up_to_two_digits(std::max(std::cbrt(cells_per_volume * model.volume() / n_cells),
                                         std::sqrt(cells_per_area * skin_area(model.faces) / n_cells)));
}

std::map<std::string, double> resolve_surface_sizes(const MeshOptions &options, const Selection &selection)
{
  std::map<std::string, double> sizes;
  for (const auto &[pattern, size] : options.surface_size)
    for (const auto &surface : selection)
      if (fnmatch(pattern.c_str(), surface.first.c_str(), 0) == 0)
      {
        const auto [entry, is_new] = sizes.try_emplace(surface.first, size);
        entry->second              = std::min(entry->second, size);
      }
  return sizes;
}

void set_mesh_sizes(const CadModel &model, const MeshOptions &options, const Selection &selection)
{
  check_size(model, options);
  check_surface_sizes(options, selection);
  const auto surface_size = resolve_surface_sizes(options, selection);
  check_number_of_cells(model, options, surface_size, selection);

  gmsh::option::setNumber("Mesh.MeshSizeMin", 0.);
  gmsh::option::setNumber("Mesh.MeshSizeMax", options.size / model.unit);
  gmsh::option::setNumber("Mesh.MinimumCircleNodes", elements_around_circle);
  set_smallest_as_background(surface_size_fields(model, options, selection));
}

std::vector<double> surface_size_fields(const CadModel &model, const MeshOptions &options, const Selection &selection)
{
  std::vector<double> fields;
  for (const auto &[name, size] : resolve_surface_sizes(options, selection))
    fields.push_back(add_field(selection.at(name), size / model.unit, options.size / model.unit));
  return fields;
}

void remove_size_fields()
{
  namespace field = gmsh::model::mesh::field;
  const int next  = field::add("Min"); // fields are counted from 1
  for (int tag = 1; tag <= next; ++tag)
    field::remove(tag);
}

void set_smallest_as_background(const std::vector<double> &fields)
{
  if (fields.empty())
    return;
  const int smallest = gmsh::model::mesh::field::add("Min");
  gmsh::model::mesh::field::setNumbers(smallest, "FieldsList", fields);
  gmsh::model::mesh::field::setAsBackgroundMesh(smallest);
}

void set_local_sizes(const std::optional<SizeField> &refined, const FaceSizes &faces, double unit)
{
  if (!refined && faces.empty())
    return;
  FaceSizes curves;
  for (const auto &[face, size] : faces)
  {
    gmsh::vectorpair boundary;
    gmsh::model::getBoundary({{2, face}}, boundary, false, false, false);
    for (const auto &[dim, curve] : boundary)
      if (const auto [entry, is_new] = curves.try_emplace(curve, size); !is_new)
        entry->second = std::min(entry->second, size);
  }
  // From gmsh 4.9 on the callback gets the minimum of all other sizes and replaces them; in earlier versions the
  // minimum of all sizes, including the callback's, is used.
  gmsh::model::mesh::setSizeCallback(
      [refined, faces, curves, unit](int dim, int tag, double x, double y, double z, auto... so_far)
      {
        constexpr double none  = std::numeric_limits<double>::max();
        const FaceSizes &sizes = dim == 2 ? faces : curves;
        const auto       size  = dim == 1 || dim == 2 ? sizes.find(tag) : sizes.end();
        return std::min({refined ? (*refined)({unit * x, unit * y, unit * z}) / unit : none,
                         size != sizes.end() ? size->second : none, so_far...});
      });
}

} // namespace gestell::fem

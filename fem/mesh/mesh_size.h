#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/curved_walls.h"
#include "fem/mesh/size_field.h"
#include "fem/values/frame_specification.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gestell::fem
{

/// Tags of the faces of each named surface.
using Selection = std::map<std::string, std::vector<int>>;

/// Growth of the element size per distance, from the size on a named surface to the global size.
constexpr double size_growth = 0.3;

/// Smallest number of elements around a full circle, independent of the size: its area is then 4.5 % too small.
constexpr int elements_around_circle = 12;

/// [m^2]
double skin_area(const std::vector<Face> &faces);

/**
 * Expected number of tetrahedra, within a factor of about 1.5:
 *     max(10 V / h^3, 4.5 A / h^2),
 * the second term for plates thinner than h; a surface of size s and area a adds 10 a / (2 growth s^2).
 *
 * @param surface_size  [m] per name of `selection`
 */
double expected_cells(const CadModel &model, double size, const std::map<std::string, double> &surface_size,
                      const Selection &selection);

/// The size [m], rounded up to two digits, for which about `n_cells` tetrahedra are expected.
double size_for_cells(const CadModel &model, double n_cells);

/// Sizes by name of surface, with the patterns ("crown bearing *") of options.surface_size resolved (smallest).
std::map<std::string, double> resolve_surface_sizes(const MeshOptions &options, const Selection &selection);

/**
 * Sets the sizes in gmsh.
 *
 * @throws std::invalid_argument if the size is <= 0 or larger than the model, a surface is unknown or its size not in
 *         (0, size], or more than options.max_cells tetrahedra are expected; the message gives a suitable size.
 */
void set_mesh_sizes(const CadModel &model, const MeshOptions &options, const Selection &selection);

/// Sets sizes of a refined mesh and of faces with their curves in gmsh, used where they are smaller than the others.
/// @param unit  length of gmsh's unit [m]
void set_local_sizes(const std::optional<SizeField> &refined, const FaceSizes &faces, double unit);

/// Creates gmsh's fields for the sizes on named surfaces.
std::vector<double> surface_size_fields(const CadModel &model, const MeshOptions &options, const Selection &selection);

/// Removes all of gmsh's fields.
void remove_size_fields();

/// Makes the smallest of gmsh's fields the size everywhere.
void set_smallest_as_background(const std::vector<double> &fields);

} // namespace gestell::fem

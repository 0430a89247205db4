#pragma once

#include "fem/geometry/cad_model.h"
#include "fem/mesh/mesh_size.h"
#include "fem/mesh/size_field.h"
#include "fem/values/frame_specification.h"

#include <optional>
#include <string>
#include <vector>

namespace gestell::fem
{

/**
 * Target element sizes of a frame, without those derived by gmsh from the edges of a face: named surfaces, faces of
 * thin walls and bores have their own size, which grows with the distance up to mesh.size; sizes of a refinement are
 * included.
 */
class WantedSize
{
public:
  WantedSize(const CadModel &model, const MeshOptions &options, const Selection &selection,
             const std::optional<SizeField> &refined, const FaceSizes &walls = {});

  double operator()(const Vector3 &x) const;    ///< [m]
  double without_bores(const Vector3 &x) const; ///< [m]

private:
  struct Region
  {
    Vector3 min, max; ///< box around it
    double  size;
  };
  static double near(const std::vector<Region> &regions, const Vector3 &x, double size);

  double                          size_; ///< [m] elsewhere
  std::vector<Region>             surfaces_, bores_;
  const std::optional<SizeField> &refined_;
};

/**
 * Ratio of the number of triangles of gmsh's surface mesh to that required by the target sizes,
 *
 *     n / (sum of 4 A / (sqrt(3) w^2) + 2 n_e),
 *
 * with A and w of each triangle, and n_e the number of sides on edges of the model, which even a narrow face needs.
 *
 * gmsh interpolates the sizes of a face's edges into its interior: with many short edges, as around a disc with 500
 * sides, the ratio is large.
 */
double excess_of_triangles(const WantedSize &wanted, double unit);

/// Whether gmsh already has size fields, for example from a script.
bool has_size_fields();

/// Edges with sides of less than half of the target size.
struct ShortEdges
{
  int    n        = 0;
  double shortest = 0.; ///< side [m]
};

/// Sets target sizes that grow from short edges for the interior; does nothing without short edges.
ShortEdges grade_from_short_edges(const WantedSize &wanted, const CadModel &model, const MeshOptions &options,
                                  const Selection &selection);

} // namespace gestell::fem

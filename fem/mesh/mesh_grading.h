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
 * Sizes that a frame's mesh is to have, without those that gmsh derives from the edges of a face: on a named surface
 * and on a bore their own, growing with the distance up to mesh.size, and those of a refinement.
 */
class WantedSize
{
public:
  WantedSize(const CadModel &model, const MeshOptions &options, const Selection &selection,
             const std::optional<SizeField> &refined);

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
 * Triangles of gmsh's mesh of the surfaces over those that the wanted sizes ask for,
 *
 *     n / (sum of 4 A / (sqrt(3) w^2) + 2 n_e),
 *
 * A and w of each triangle, n_e the sides on edges of the model: that many a face needs at least, however narrow.
 *
 * gmsh carries the sizes of a face's edges through its inside: where many are short, as around a disc of 500 sides,
 * that is a multiple.
 */
double excess_of_triangles(const WantedSize &wanted, double unit);

/// Whether gmsh has fields of sizes already, as a script may draw them.
bool has_size_fields();

/// Edges whose sides are less than half of the wanted size.
struct ShortEdges
{
  int    n        = 0;
  double shortest = 0.; ///< side [m]
};

/// Tells gmsh to mesh insides by the wanted sizes, which grow from short edges; does nothing if there are none.
ShortEdges grade_from_short_edges(const WantedSize &wanted, const CadModel &model, const MeshOptions &options,
                                  const Selection &selection);

} // namespace gestell::fem

#pragma once

#include "fem/geometry/cad_model.h"

#include <string>
#include <vector>

namespace gestell::fem
{

/// The smallest features of a CAD model, which force small elements regardless of mesh.size.
struct SmallFeatures
{
  double  shortest_edge = 0.; ///< [m]
  Vector3 edge_at{};
  double  narrowest_face = 0.; ///< width 2 A / P of area A and perimeter P [m]
  int     face           = 0;  ///< its tag
  Vector3 face_at{};
  int     n_short_edges = 0, n_narrow_faces = 0; ///< below a limit
};

/// @param limit  [m] below which edges and faces are counted
SmallFeatures small_features(const CadModel &model, double limit);

/// Tags of faces of gmsh's model that are narrower than the size [m], or bores and pins of a smaller diameter.
std::vector<int> faces_smaller_than(const CadModel &model, double size);

/// "shortest edge 0.02 mm at (0 0 0.1); narrowest face 12, 0.1 mm wide at (...)"
std::string describe(const SmallFeatures &features);

} // namespace gestell::fem

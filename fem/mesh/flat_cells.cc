#include "fem/mesh/flat_cells.h"

#include "fem/mesh/cell_measures.h"
#include "fem/mesh/gmsh_child.h"
#include "fem/values/message_text.h"
#include "fem/values/vector3.h"

#include <stdexcept>

namespace gestell::fem
{

namespace
{

template <typename Failure>
void require_thick(const Mesh &mesh, int cell, const std::string &head, const std::string &way_out)
{
  const double     q        = cell_quality(mesh, cell);
  constexpr double flattest = 1e-5; // quality; flatter cells spoil the condition of C
  if (q >= flattest)
    return;
  const int n = cell_shape(mesh.kind(cell)).n_corners;
  Vector3   centre{};
  for (int k = 0; k < n; ++k)
    centre = centre + (1. / n) * mesh.points[mesh.corners(cell)[k]];
  throw Failure(head + ": the mesh has a flat cell at " + text(centre) + " m (quality " + text(q) + ", needed " +
                text(flattest) + "); " + way_out);
}

} // namespace

void require_thick_cells(const Mesh &mesh, bool meshed, const std::string &head)
{
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    if (meshed)
      require_thick<std::invalid_argument>(
          mesh, cell, head, "its volume is nearly zero or negative: repair it in the program that made the mesh.");
    else
      require_thick<NotMeshed>(mesh, cell, head, "choose another mesh.size, or a smaller one on the surface there.");
}

} // namespace gestell::fem

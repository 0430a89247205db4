#include "fem/mesh/solid_volumes.h"

#include "fem/mesh/curved_sides.h"
#include "fem/values/message_text.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gestell::fem
{

namespace
{

std::string name_of(const Solid &solid)
{
  return solid.name.empty() ? "solid " + std::to_string(solid.tag) : "solid \"" + solid.name + "\"";
}

} // namespace

std::vector<double> volumes_of_solids(const Mesh &mesh, std::size_t n_solids)
{
  std::vector<double>       result(n_solids, 0.);
  const std::vector<double> volumes = curved_volumes(mesh);
  std::size_t               piece   = 0;
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
    for (std::size_t k = 0; k < cell_shape(mesh.kind(cell)).pieces.size(); ++k)
      result.at(mesh.cell_solid[cell]) += volumes[piece++];
  return result;
}

void note_volumes(Mesh &mesh, const std::vector<Solid> &solids, const MeshOptions &options)
{
  const std::vector<double> volumes   = volumes_of_solids(mesh, solids.size());
  const bool                may_curve = !options.curved && mesh.only_tetrahedra();
  for (std::size_t i = 0; i < volumes.size(); ++i)
  {
    const double off = solids[i].volume > 0. ? volumes[i] / solids[i].volume - 1. : 0.;
    // Share of the volume above which a note states the difference: frequencies change by half of it, and results are
    // usually needed to one percent.
    constexpr double volume_off = 0.005;
    if (std::abs(off) > volume_off)
      mesh.notes.push_back(name_of(solids[i]) + ": the mesh has " + text(100. * std::abs(off)) + " % " +
                           (off < 0. ? "less" : "more") + " mass than the geometry (" + text(volumes[i]) + " for " +
                           text(solids[i].volume) + " m^3), because straight sides of cells cut off curved faces. " +
                           (may_curve ? "Write mesh = { curved = true }, or make cells smaller along curved faces."
                                      : "Make cells smaller along curved faces."));
  }
}

void measure_solids(CadModel &model, const Mesh &mesh)
{
  const std::vector<double> volumes = volumes_of_solids(mesh, model.solids.size());
  for (std::size_t i = 0; i < volumes.size(); ++i)
  {
    model.solids[i].volume += volumes[i];
    model.solids[i].min = model.max;
    model.solids[i].max = model.min;
  }
  for (int cell = 0; cell < mesh.n_cells(); ++cell)
  {
    const CellShape &shape = cell_shape(mesh.kind(cell));
    Solid           &solid = model.solids[mesh.cell_solid[cell]];
    for (int k = 0; k < shape.n_corners; ++k)
      for (int d = 0; d < 3; ++d)
      {
        const double x = mesh.points[mesh.corners(cell)[k]][d];
        solid.min[d]   = std::min(solid.min[d], x);
        solid.max[d]   = std::max(solid.max[d], x);
      }
  }
}

} // namespace gestell::fem

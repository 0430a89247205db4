#pragma once

#include "fem/values/frame_specification.h"
#include "fem/values/mesh.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::fem
{

/// The materials of a frame and the material of each cell, with the displacement that prestresses them.
struct CellMaterials
{
  std::vector<Material> materials; ///< of each solid
  std::vector<int>      of_cell;   ///< index into materials
  Eigen::Matrix3Xd      u0{};      ///< [3 x n_nodes] under the prestressing loads [m], or empty

  const Material &operator[](std::size_t cell) const { return materials[of_cell[cell]]; }
};

/// @throws std::invalid_argument unless E > 0, -1 < nu < 0.5, rho > 0, all finite.
void require_valid(const Material &material);

/**
 * The material of each solid, see materials_of(); rho = 0 stands for the density of the file.
 *
 * @throws std::invalid_argument for impossible materials (require_valid) and for a pattern without a matching solid,
 * with the names of solids.
 */
CellMaterials cell_materials(const Mesh &mesh, const FrameSpecification &specification);

} // namespace gestell::fem

#include "fem/assembly/assembled_matrices.h"

#include "fem/assembly/elasticity.h"
#include "fem/assembly/mass_integrals.h"

#include <numeric>

namespace gestell::fem
{

AssembledMatrices sum_cells(const QuadraticMesh &mesh, const CellMaterials &materials, const AffineConstraints &affine)
{
  const Eigen::Vector3d middle = middle_of_nodes(mesh);
  AssembledMatrices     sums;
  // Each full matrix goes as soon as it is projected: two of them at once would set the peak of the memory.
  {
    std::vector<int> nodes(mesh.n_nodes());
    std::iota(nodes.begin(), nodes.end(), 0);
    const BlockMatrix C = assemble_stiffness(mesh, materials);
    sums.rigid_energy   = rigid_energies(mesh, C, middle, nodes).share();
    sums.C              = affine.project(C);
  }
  const BlockMatrix M      = assemble_mass(mesh, materials);
  const NodalMasses masses = nodal_masses(mesh, M, middle);
  sums.M                   = affine.project(M);
  sums.whole               = mass_integrals(mesh, masses, middle);
  sums.nodal_mass          = masses.mass;
  return sums;
}

} // namespace gestell::fem

#include "fem/part_sums.h"

#include "fem/elasticity.h"

namespace gestell::fem
{

namespace
{

/// Rows of a symmetric matrix.
CompressedRows rows_of(const Eigen::SparseMatrix<double> &A, const std::vector<int> &chosen)
{
  CompressedRows rows;
  for (const int i : chosen)
  {
    for (Eigen::SparseMatrix<double>::InnerIterator a(A, i); a; ++a)
    {
      rows.column.push_back(static_cast<int>(a.row()));
      rows.value.push_back(a.value());
    }
    rows.begin.push_back(static_cast<int>(rows.column.size()));
  }
  return rows;
}

} // namespace

PartSums sum_part(const FramePart &part, const Eigen::Vector3d &middle)
{
  PartSums sums;
  if (part.mesh.n_cells() == 0)
  {
    sums.C.begin.resize(part.own_coordinates.size() + 1, 0);
    sums.M = sums.C;
    return sums;
  }
  const Kinematics kinematics(part.kinematics);
  {
    const BlockMatrix C = assemble_stiffness(part.mesh, part.materials);
    sums.energies       = rigid_energies(part.mesh, C, middle, part.own_nodes);
    sums.C              = rows_of(kinematics.project(C), part.own_coordinates);
  }
  const BlockMatrix M      = assemble_mass(part.mesh, part.materials);
  const NodalMasses masses = nodal_masses(part.mesh, M, middle);
  sums.masses              = {masses.mass(part.own_nodes), masses.moment(Eigen::all, part.own_nodes)};
  sums.M                   = rows_of(kinematics.project(M), part.own_coordinates);
  return sums;
}

} // namespace gestell::fem

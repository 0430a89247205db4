#pragma once

#include "coupling/reduction/shared_matrices.h"
#include "fem/cell_sums.h"

#include <memory>

namespace gestell::coupling
{

/// What rank 0 has of a frame whose cells are to be summed up; see fem::CellAssembly.
struct AssemblySource
{
  const fem::QuadraticMesh          &mesh;
  const fem::CellMaterials          &materials;
  const fem::Kinematics             &kinematics;
  const Eigen::SparseMatrix<double> &C_beside, &M_beside;
};

/**
 * Sums up C and M, each rank the rows of its part of the frame (fem::divide()) from the cells it needs for them, of
 * which it has nothing else; then rank 0 collects all rows.  Each entry is the sum of one process, in the same order.
 * Collective.
 *
 * @param source nullptr on the ranks above 0.
 * @param sums   of rank 0: all but `rows`.
 */
std::shared_ptr<const SharedMatrices> assemble_on_ranks(const fem::Ranks &ranks, const AssemblySource *source,
                                                        fem::CellSums &sums);

} // namespace gestell::coupling

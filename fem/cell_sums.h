#pragma once

#include "fem/cell_materials.h"
#include "fem/frame_matrices.h"
#include "fem/kinematics.h"
#include "fem/quadratic_mesh.h"

#include <memory>

namespace gestell::fem
{

/// The C and M of a frame once more, with their rows on all ranks that mpirun started.
class RowsOnRanks
{
public:
  virtual ~RowsOnRanks() = default;
};

/// What the cells of a frame add up to.
struct CellSums
{
  SparseMatrix                       C, M;              ///< [n x n] in the coordinates of the frame
  double                             rigid_energy = 0.; ///< FrameFacts::rigid_energy
  Eigen::VectorXd                    nodal_mass;        ///< [n_nodes] kg
  MassProperties                     whole;
  std::shared_ptr<const RowsOnRanks> rows; ///< if several ranks have summed them up
};

/// By this process alone.
CellSums sum_cells(const QuadraticMesh &mesh, const CellMaterials &materials, const Kinematics &kinematics);

/// Several ranks that share the cells among them and sum up their matrices: each entry in the order of sum_cells(), so
/// that it is the same to the last bit.
class CellAssembly
{
public:
  virtual ~CellAssembly() = default;

  /// @param C_beside, M_beside [n x n] of foundations and attached masses, which the ranks add to their rows.
  /// @returns C and M without them.
  virtual CellSums sum(const QuadraticMesh &mesh, const CellMaterials &materials, const Kinematics &kinematics,
                       const Eigen::SparseMatrix<double> &C_beside,
                       const Eigen::SparseMatrix<double> &M_beside) const = 0;
};

} // namespace gestell::fem

#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/sparse_matrix.h"

#include <string>
#include <vector>

namespace gestell::fem
{

/// Sums over the cells of one part, in the coordinates of the frame that move them.
struct PartMatrices
{
  SparseMatrix     C, M;        // [n_p x n_p]
  std::vector<int> coordinates; ///< [n_p] of the frame, ascending
};

/**
 * The cells of a frame in parts of about equal size with few common nodes: METIS divides the graph of the cells, two of
 * which are neighbours if they share a face.  Cells that an averaged surface ties to a common
 * displacement stay together; its inner coordinates and the node of an interface or a mass may belong to several parts.
 * The sum of the matrices of all parts is the matrix of the frame: constraints are those of the whole frame.
 *
 * Refers to its arguments.
 */
class CellParts
{
public:
  /// @throws std::invalid_argument, beginning with `place`, if there are fewer cells that can be separated than parts.
  CellParts(const QuadraticMesh &mesh, const CellMaterials &materials, const AffineConstraints &affine, int n_parts,
            const std::string &place);

  int              size() const { return int(cells_.size()); }
  int              n_coordinates() const { return affine_.n_coordinates(); }
  std::vector<int> coordinates(int part) const; ///< as PartMatrices::coordinates
  PartMatrices     matrices(int part) const;    ///< C with geometric()
  SparseMatrix     geometric(int part) const;   ///< stiffness [n_p x n_p] under CellMaterials::u0, or empty

private:
  const QuadraticMesh          &mesh_;
  const CellMaterials          &materials_;
  const AffineConstraints      &affine_;
  std::vector<std::vector<int>> cells_; // of every part, ascending
};

} // namespace gestell::fem

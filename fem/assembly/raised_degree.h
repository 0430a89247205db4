#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/values/frame_matrices.h"

#include <array>
#include <vector>

namespace gestell::fem
{

/**
 * Functions of degree three in addition to the quadratics N of a mesh, each a linear function times one of them:
 *
 *     tetrahedra:  (L_a - L_b) N_ab  of every edge,  L_c N_ab  of every face: with them all cubics
 *     hexahedra:   (2 xi_d - 1) N_m  for the middle m of every line of nodes along xi_d
 *     prisms:      those of the triangle at each of three heights, and along the height
 *
 * They vanish on all other faces, edges and lines of nodes, so that neighbours share them.
 */
class CubicFunctions
{
public:
  explicit CubicFunctions(const QuadraticMesh &mesh);

  /// A function within the reference cell.
  struct Local
  {
    int                amid;        ///< node m with the factor N of the function
    Eigen::Vector4d    line;        ///< l = line[0] + line[1..3] . xi
    std::array<int, 3> nodes;       ///< nodes that identify its location
    bool               odd;         ///< whether it changes its sign with the order of nodes[0] and nodes[2]
    std::vector<int>   vanish_with; ///< it is zero if all these nodes are fixed
  };

  int                              size() const { return static_cast<int>(vanish_with_.size()); }
  static const std::vector<Local> &of_cell(CellKind kind);
  /// Number and sign of every function of a cell.
  const std::vector<std::pair<int, double>> &numbers(int cell) const { return numbers_[cell]; }
  const std::vector<int>                    &vanish_with(int function) const { return vanish_with_[function]; }

private:
  std::vector<std::vector<std::pair<int, double>>> numbers_;
  std::vector<std::vector<int>>                    vanish_with_;
};

/// A frame in elements of degree three on the same mesh: its DOFs and those of the cubic functions.
struct RaisedFrame
{
  SparseMatrix     C, M;
  std::vector<int> place; ///< new index of each coordinate of the frame
};

/**
 * Its C and M extended by cubic functions, which vanish on clamped surfaces and interfaces; foundations and attached
 * masses act on the quadratics only.
 *
 * @param C, M  of the frame.
 */
RaisedFrame raise_degree(const QuadraticMesh &mesh, const CellMaterials &materials, const AffineConstraints &affine,
                         const SparseMatrix &C, const SparseMatrix &M);

/// Approximate number of DOFs for a frame with n: 3.5 functions per tetrahedron, 16 per hexahedron, 9.5 per prism (thin
/// walls).
double raised_coordinates(const QuadraticMesh &mesh, double n);

} // namespace gestell::fem

#pragma once

#include <Eigen/SparseCore>

#include <petscmat.h>

#include <vector>

namespace gestell::fem
{
class Ranks;
}

namespace gestell::coupling
{

/**
 * The pattern of a symmetric sparse matrix as a graph for METIS.  Neighbouring rows with the same entries, such as the
 * three of a node, are one vertex.
 */
class MatrixGraph
{
public:
  /// Of a matrix [n x n] with both triangles stored, rows ascending in each column.
  explicit MatrixGraph(const Eigen::SparseMatrix<double> &A);
  /// Collected on rank 0 from a matrix whose rows lie on all ranks; collective, of no vertex on other ranks.
  /// @param held rows (ascending) that are left out but for their diagonal.
  MatrixGraph(const fem::Ranks &ranks, Mat A, const std::vector<int> &held);

  /// Which of `parts` every row belongs to [n]: parts alike in size, few entries between them.
  std::vector<int> parts(int parts) const;
  /// Place of every row in an elimination with little fill, by nested dissection [n].
  std::vector<int> elimination_places() const;

private:
  int n_vertices() const { return int(first_.size()) - 1; }

  std::vector<int> first_;             // row of each vertex, and n
  std::vector<int> begin_, neighbour_; // compressed lists
};

} // namespace gestell::coupling

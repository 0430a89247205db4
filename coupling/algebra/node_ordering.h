#pragma once

#include <Eigen/SparseCore>

#include <suitesparse/cholmod.h>

#include <vector>

namespace gestell::coupling
{

/// Columns of a sparse matrix without its numbers.
struct SparsePattern
{
  int              n = 0;
  std::vector<int> begin, rows;
};

/// CHOLMOD's view of the lower triangle of a symmetric pattern; valid as long as that lives.
cholmod_sparse view_of(SparsePattern &lower);

/// Lower triangle of A without the couplings of the coordinates held (marks [n] or empty), diagonal complete.
SparsePattern lower_triangle(const Eigen::SparseMatrix<double> &A, const std::vector<char> &held);

/**
 * Fill-reducing order of elimination: nested dissection by METIS, through CHOLMOD, of the graph whose
 * vertices are groups of coordinates with the same partners, as the three displacements of a node are.  The graph has a
 * ninth of the edges, and METIS needs as much less time.
 *
 * @param A  compressed, both triangles stored.
 * @return   [n] the coordinate to be eliminated as k-th.
 * @throws   std::bad_alloc.
 */
std::vector<int> node_ordering(const Eigen::SparseMatrix<double> &A, const std::vector<char> &held,
                               cholmod_common &common);

} // namespace gestell::coupling

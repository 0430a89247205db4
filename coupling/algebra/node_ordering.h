#pragma once

#include <Eigen/SparseCore>

#include <suitesparse/cholmod.h>

#include <vector>

namespace gestell::coupling
{

/**
 * Fill-reducing order of elimination: nested dissection by METIS, through CHOLMOD, of the graph whose
 * vertices are groups of coordinates with the same partners, as the three displacements of a node are.  The graph has a
 * ninth of the edges, and METIS needs as much less time.
 *
 * @param A     compressed, both triangles stored.
 * @param held  marks [n] of fixed coordinates, whose couplings do not count; or empty.
 * @return      [n] the coordinate to be eliminated as k-th.
 * @throws      std::bad_alloc.
 */
std::vector<int> node_ordering(const Eigen::SparseMatrix<double> &A, const std::vector<char> &held);

/// Lower triangle of A without the couplings of the fixed coordinates, diagonal complete: CHOLMOD's view, with indices
/// of 64 bit so that a factor may have more than 2^31 numbers.
class LowerPattern
{
public:
  LowerPattern(const Eigen::SparseMatrix<double> &A, const std::vector<char> &held);
  cholmod_sparse *view() { return &view_; }
  /// Starts `common` and analyses this pattern for a supernodal factor; the caller ends it by cholmod_l_finish().
  /// @returns nullptr, or a factor with a failure in `common`, if the memory does not suffice.
  cholmod_factor *analysed(const std::vector<int> &order, cholmod_common &common);

private:
  std::vector<SuiteSparse_long> begin_{0}, rows_;
  cholmod_sparse                view_{};
};

} // namespace gestell::coupling

#pragma once

#include "coupling/parallel/petsc_objects.h"

#include <memory>
#include <vector>

namespace gestell::coupling
{

/**
 * Factor of a sparse symmetric matrix whose rows lie on several ranks, A = P^T L D L^T P, by MUMPS; it lies on them,
 * too.
 *
 * Every function is collective.  Failures are those of all ranks: fem::AgreedFailure, with MUMPS' code.
 */
class MumpsFactor
{
public:
  enum class Sign
  {
    positive,  ///< definite: no pivoting
    indefinite ///< pivots are chosen, and the negative ones counted
  };

  /// A + factor B, of which no matrix is made.
  struct Shifted
  {
    Mat    A;
    Mat    B      = nullptr; ///< rows as those of A; nullptr: A alone
    double factor = 0.;
  };

  /// @param A      [n x n] MATMPIAIJ; only the lower triangles are read.
  /// @param held   rows, ascending, the same on all ranks, that count as if A had nothing there but its |diagonal|.
  /// @param places rank 0: place of every row in the elimination [n]; on others empty.
  MumpsFactor(const Shifted &A, const std::vector<int> &held, const std::vector<int> &places, Sign sign);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor &)            = delete;
  MumpsFactor &operator=(const MumpsFactor &) = delete;

  /// The matrix is singular to working precision, or its factor would need the root of a negative number.
  bool failed() const;
  int  negative_pivots() const;

  /// Rank 0: X <- A^-1 X for columns of n numbers one after the other; not read on others.
  void solve_on_first(double *X, int columns);
  /// x <- A^-1 f for vectors with A's rows; f and x differ.
  void solve(Vec f, Vec x);

  /// [MB] that MUMPS uses: largest of all ranks, and their sum.
  double largest_memory() const;
  double whole_memory() const;

private:
  struct Instance;
  std::unique_ptr<Instance> instance_;
};

} // namespace gestell::coupling

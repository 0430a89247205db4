#pragma once

#include "coupling/algebra/multifrontal.h"
#include "coupling/algebra/multivector.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// The matrix is not positive definite: the pivot of coordinate `row` is not positive (or is nan).
class NotPositiveDefinite : public std::runtime_error
{
public:
  explicit NotPositiveDefinite(int row)
      : std::runtime_error("matrix not positive definite at row " + std::to_string(row)), row(row)
  {
  }
  int row;
};

/// The factor does not fit into the available memory.
class NotEnoughMemory : public std::runtime_error
{
public:
  NotEnoughMemory(double needed, double available);
};

/**
 * Factor L of a sparse symmetric positive definite matrix, A = P^T L L^T P: ordered by METIS on the graph of the nodes
 * (coordinates with the same partners), analysed by CHOLMOD, factored by multifrontal_cholesky(), solved in the tiles
 * of TiledFactor.
 *
 * Right-hand sides solved together share the pass through L, the main cost: 16 at once take about a tenth per vector of
 * a single one.  OpenBLAS, which does the arithmetic, is set to one thread: its waiting threads spin.
 *
 * Not for use by several threads at a time.
 */
class SparseCholesky
{
public:
  /// @param A [n x n]; only its lower triangle is read.
  /// @throws NotPositiveDefinite; std::invalid_argument if A is not square; std::bad_alloc.
  explicit SparseCholesky(const Eigen::SparseMatrix<double> &A);
  /// The same for a compressed matrix with both triangles and fixed coordinates `held`: their rows and columns are
  /// treated as zero except for a positive diagonal entry.
  /// @param held       ascending.
  /// @param available  bytes for L and its work space.
  /// @throws NotEnoughMemory before the work begins.
  SparseCholesky(const Eigen::SparseMatrix<double> &A, const std::vector<int> &held, double available = INFINITY);
  /// Only the analysis, as after release(): A may be singular.
  static SparseCholesky without_numbers(const Eigen::SparseMatrix<double> &A, const std::vector<int> &held);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky &&) noexcept;
  SparseCholesky &operator=(SparseCholesky &&) noexcept;

  /// Computes L for a matrix A with the pattern of the analysed one, both triangles; otherwise as the constructor.
  void factorise(const Eigen::SparseMatrix<double> &A, double available = INFINITY);

  int size() const;

  /// X <- A^-1 X for all columns.
  void solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const;
  /// x <- A^-1 f for n numbers at f and x, which may coincide.
  void solve(const double *f, double *x) const;

  /// (smallest / largest diagonal entry of L)^2: a rough lower bound of the distance of A from singularity.
  double pivot_ratio() const;
  /// Valid during the lifetime of this object.
  Fronts fronts() const;
  /// Coordinate of A at every position in the order of elimination.
  std::vector<int> order() const;
  /// The same for right-hand sides in that order: X(k, :) belongs to coordinate order()[k].
  void solve_in_place(MultiVector &X) const;

  /// Number of entries of L.
  double entries() const;

  /// Frees the memory of L; afterwards only inertia() is available.
  void release();
  bool released() const;

  /// Eigenvalues of (C - lambda M) x = 0 below sigma, without the fixed coordinates; see multifrontal_inertia().
  /// @param C  the matrix of this factor, or one with its pattern, both triangles; the pattern of M is part of it.
  Inertia inertia(const Eigen::SparseMatrix<double> &C, const Eigen::SparseMatrix<double> &M, double sigma) const;

private:
  struct Factor;
  SparseCholesky();
  std::unique_ptr<Factor> factor_;
};

/// Whether C has an entry wherever M has one.
bool contains(const Eigen::SparseMatrix<double> &C, const Eigen::SparseMatrix<double> &M);

} // namespace gestell::coupling

#pragma once

#include <Eigen/Core>

#include <memory>

namespace gestell::coupling
{

/**
 * Eigen's dense solvers for matrices of any size, compiled once because each costs some seconds of compile time.  Names
 * and meaning are those of Eigen.
 */

enum class WithVectors
{
  yes,
  no
};

/// A v = lambda v, A symmetric [n x n]; lambda ascending, vectors orthonormal.
class SymmetricEigenSolver
{
public:
  explicit SymmetricEigenSolver(const Eigen::MatrixXd &A, WithVectors vectors = WithVectors::yes);

  const Eigen::VectorXd &eigenvalues() const { return values_; }
  const Eigen::MatrixXd &eigenvectors() const { return vectors_; } ///< [n x n], columns; empty without them
  bool                   converged() const { return converged_; }

private:
  Eigen::VectorXd values_;
  Eigen::MatrixXd vectors_;
  bool            converged_ = false;
};

/// A v = lambda B v, A symmetric, B positive definite; lambda ascending, V^T B V = E.
class SymmetricPencilSolver
{
public:
  SymmetricPencilSolver(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B, WithVectors vectors = WithVectors::yes);

  const Eigen::VectorXd &eigenvalues() const { return values_; }
  const Eigen::MatrixXd &eigenvectors() const { return vectors_; }
  bool                   converged() const { return converged_; }

private:
  Eigen::VectorXd values_;
  Eigen::MatrixXd vectors_;
  bool            converged_ = false;
};

/// A v = lambda v, A any square matrix.
class GeneralEigenSolver
{
public:
  explicit GeneralEigenSolver(const Eigen::MatrixXd &A, WithVectors vectors = WithVectors::yes);

  const Eigen::VectorXcd &eigenvalues() const { return values_; }
  const Eigen::MatrixXcd &eigenvectors() const { return vectors_; }
  bool                    converged() const { return converged_; }

private:
  Eigen::VectorXcd values_;
  Eigen::MatrixXcd vectors_;
  bool             converged_ = false;
};

/// The x of least norm among those with least |A x - b|, by a complete orthogonal decomposition.
class LeastSquaresSolver
{
public:
  LeastSquaresSolver();
  /// @param threshold  relative to the largest pivot, below which pivots are zero; 0: rounding
  explicit LeastSquaresSolver(const Eigen::MatrixXd &A, double threshold = 0.);
  ~LeastSquaresSolver();
  LeastSquaresSolver(LeastSquaresSolver &&) noexcept;
  LeastSquaresSolver &operator=(LeastSquaresSolver &&) noexcept;

  template <class Columns>
  Eigen::Matrix<double, Eigen::Dynamic, Columns::ColsAtCompileTime> solve(const Eigen::MatrixBase<Columns> &B) const
  {
    return solution(B);
  }
  Eigen::Index    rank() const;
  Eigen::MatrixXd null_space() const; ///< orthonormal columns x with A x = 0 [n x (n - rank)]

private:
  struct Decomposition;

  Eigen::MatrixXd solution(const Eigen::MatrixXd &B) const;

  std::unique_ptr<Decomposition> decomposition_;
};

/// x with A x = b, A square and regular, by LU with partial pivoting.
Eigen::MatrixXd lu_solution(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B);

/// Orthonormal columns that span those of A; if k exceeds the number of columns of A, also complements [n x k].
Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd &A, Eigen::Index k);

} // namespace gestell::coupling

#pragma once

#include <Eigen/QR>

#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Least squares by Householder's QR with column pivoting, of columns scaled to length 1:
 *
 *     b = arg min |X b - y|,      X D P = Q R,      (X^T X)^-1 = D P R^-1 R^-T P^T D,      leverage h_ii = |Q_i|^2.
 *
 * Source: Golub & Van Loan, Matrix Computations, 5.3 and 5.4; docs/theory/response_surfaces.md (3) and (4)
 */
class LeastSquares
{
public:
  /// @param X      [n x p], n >= p
  /// @param names  of the columns, for messages
  /// @throws std::invalid_argument for fewer rows than columns, or columns that depend on each other: which, and how
  LeastSquares(const Eigen::MatrixXd &X, const std::vector<std::string> &names);

  Eigen::VectorXd        solve(const Eigen::VectorXd &y) const;
  const Eigen::MatrixXd &inverse_normal() const { return inverse_normal_; } ///< (X^T X)^-1 [p x p]
  const Eigen::VectorXd &leverage() const { return leverage_; }             ///< [n], sums to p
  int                    n_rows() const { return static_cast<int>(leverage_.size()); }
  int                    n_columns() const { return static_cast<int>(scale_.size()); }

private:
  Eigen::VectorXd                             scale_; ///< the diagonal of D
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr_;
  Eigen::MatrixXd                             inverse_normal_;
  Eigen::VectorXd                             leverage_;
};

} // namespace gestell::apps

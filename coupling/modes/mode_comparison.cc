#include "coupling/modes/mode_comparison.h"

#include "coupling/modes/mode_tracking.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

/// 1 / sum_j A_kj^2; 0 for a measure that does not move.
Eigen::VectorXd apparent_masses(const Eigen::MatrixXd &A, const Eigen::MatrixXd &other)
{
  Eigen::VectorXd masses(A.rows());
  for (Eigen::Index k = 0; k < A.rows(); ++k)
  {
    const double     own = A.row(k).squaredNorm(), his = other.row(k).squaredNorm();
    constexpr double does_not_move = 1e-12; // of a measure in the modes of one machine, relative to the other
    masses[k]                      = std::min(own, his) > does_not_move * std::max(own, his) ? 1. / own : 0.;
  }
  return masses;
}

/// sum_k m_k A_ki^2 [modes]
Eigen::VectorXd norms(const Eigen::VectorXd &mass, const Eigen::MatrixXd &A)
{
  return A.cwiseAbs2().transpose() * mass;
}

double quotient(double x, double y)
{
  return y > 0. ? x / y : 0.;
}

/// For each row of `value` [a x b] one column, no column twice, with the largest sum; -1 for rows without one.
std::vector<int> partners(const Eigen::MatrixXd &value)
{
  if (value.rows() <= value.cols())
    return best_assignment(value);
  std::vector<int> of_row(std::size_t(value.rows()), -1);
  const auto       of_column = best_assignment(value.transpose());
  for (std::size_t j = 0; j < of_column.size(); ++j)
    of_row[std::size_t(of_column[j])] = int(j);
  return of_row;
}

} // namespace

ModeComparison compare_modes(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B)
{
  const Eigen::VectorXd of_a = apparent_masses(A, B), of_b = apparent_masses(B, A);
  ModeComparison        result;
  result.mass                 = of_a.cwiseProduct(of_b).cwiseSqrt();
  result.seen_a               = norms(of_a, A);
  result.seen_b               = norms(of_b, B);
  const Eigen::MatrixXd cross = A.transpose() * result.mass.asDiagonal() * B;
  const Eigen::VectorXd a = norms(result.mass, A), b = norms(result.mass, B);
  result.mac            = cross.cwiseAbs2();
  Eigen::MatrixXd value = result.mac;
  for (Eigen::Index i = 0; i < cross.rows(); ++i)
    for (Eigen::Index j = 0; j < cross.cols(); ++j)
    {
      result.mac(i, j)    = quotient(result.mac(i, j), a[i] * b[j]);
      const bool reported = result.seen_a[i] >= least_seen && result.seen_b[j] >= least_seen;
      value(i, j)         = reported ? result.mac(i, j) * result.seen_a[i] * result.seen_b[j] : 0.;
    }
  if (value.size() == 0)
    return result;
  const std::vector<int> chosen = partners(value);
  for (Eigen::Index i = 0; i < value.rows(); ++i)
    if (const int j = chosen[std::size_t(i)]; j >= 0 && value(i, j) > 0. && result.mac(i, j) >= least_assurance)
      result.pairs.push_back({int(i), j, result.mac(i, j), cross(i, j) < 0.});
  return result;
}

} // namespace gestell::coupling

#include "apps/study/surface/least_squares.h"

#include "fem/values/number_text.h"

#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// Lengths of the columns, inverted; 1 for a column of zeros.
Eigen::VectorXd inverse_lengths(const Eigen::MatrixXd &X)
{
  return X.colwise().norm().transpose().unaryExpr([](double length) { return length > 0. ? 1. / length : 1.; });
}

/// " + 2 x1^2", the sign first.
std::string signed_part(double factor, const std::string &name, bool is_first)
{
  const std::string sign   = factor < 0. ? (is_first ? "-" : " - ") : (is_first ? "" : " + ");
  const double      size   = std::abs(factor);
  const bool        is_one = std::abs(size - 1.) < 1e-6;
  return sign + (name == "1" ? short_text(size) : is_one ? name : short_text(size) + " " + name);
}

/// "x4^2 = 4 - x1^2 - x2^2": the first column beyond the rank by those within it.
std::string dependence(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> &qr, const Eigen::VectorXd &scale,
                       const std::vector<std::string> &names, Eigen::Index column)
{
  const Eigen::Index    rank = qr.rank();
  const Eigen::MatrixXd R    = qr.matrixR().topRows(rank);
  const Eigen::VectorXd by   = R.leftCols(rank).triangularView<Eigen::Upper>().solve(R.col(column));
  const auto           &from = qr.colsPermutation().indices();
  std::string           text;
  for (Eigen::Index i = 0; i < rank; ++i)
    if (std::abs(by(i)) > 1e-7)
      text += signed_part(by(i) * scale(from(i)) / scale(from(column)), names[from(i)], text.empty());
  return names[from(column)] + " = " + (text.empty() ? "0" : text);
}

/// What a singular design cannot tell apart.
std::string confounded(const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> &qr, const Eigen::VectorXd &scale,
                       const std::vector<std::string> &names)
{
  constexpr Eigen::Index most = 4; // dependences of a message
  const Eigen::Index     n    = qr.matrixQR().cols() - qr.rank();
  std::string            text;
  for (Eigen::Index i = 0; i < std::min(n, most); ++i)
    text += (i ? "; " : "") + dependence(qr, scale, names, qr.rank() + i);
  return n > most ? text + "; and " + std::to_string(n - most) + " more" : text;
}

} // namespace

LeastSquares::LeastSquares(const Eigen::MatrixXd &X, const std::vector<std::string> &names) : scale_(inverse_lengths(X))
{
  const Eigen::Index n = X.rows(), p = X.cols();
  if (n < p)
    throw std::invalid_argument("study: " + count_text(n, "run") + " for " + count_text(p, "coefficient") +
                                " of the surface; make more runs, or use a surface of lower order");
  // Below it a pivot of a column of length 1 is rounding: designs are coded, their columns of the size of one.
  constexpr double smallest_pivot = 1e-9;
  qr_.setThreshold(smallest_pivot);
  qr_.compute(X * scale_.asDiagonal());
  if (qr_.rank() < p)
    throw std::invalid_argument("study: the design is singular: on all its " + std::to_string(n) + " runs " +
                                confounded(qr_, scale_, names) +
                                "; add runs that differ in this (centre points, another alpha, more levels), or use a "
                                "surface of lower order");

  const Eigen::MatrixXd Q = qr_.householderQ() * Eigen::MatrixXd::Identity(n, p);
  leverage_               = Q.rowwise().squaredNorm();
  const Eigen::MatrixXd R_inverse =
      qr_.matrixR().topRows(p).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(p, p));
  const Eigen::MatrixXd root = scale_.asDiagonal() * (qr_.colsPermutation() * R_inverse);
  inverse_normal_            = root * root.transpose();
}

Eigen::VectorXd LeastSquares::solve(const Eigen::VectorXd &y) const
{
  return scale_.cwiseProduct(qr_.solve(y));
}

} // namespace gestell::apps

#include "apps/output/interactive/short_motion.h"

#include <Eigen/LU>

#include <cmath>

namespace gestell::apps
{
namespace
{

/// Instants whose columns U_p span all others within the tolerance, and the factor L [instants x p] of
///
///     U^T U = L L^T + R,    diag(R)_k <= tolerance^2,    U = U_p L_p^-T L^T up to the root of diag(R)_k in column k:
///
/// Cholesky's factorisation that takes the instant with the largest rest next and ends when all are small.
struct SpanningInstants
{
  std::vector<Eigen::Index> taken;
  Eigen::MatrixXd           factor;

  SpanningInstants(const Eigen::MatrixXd &gram, double tolerance) : factor(gram.rows(), 0)
  {
    Eigen::VectorXd rest = gram.diagonal();
    Eigen::Index    next = 0;
    while (rest.maxCoeff(&next) > tolerance * tolerance && factor.cols() < gram.cols())
    {
      const Eigen::VectorXd column = (gram.col(next) - factor * factor.row(next).transpose()) / std::sqrt(rest(next));
      taken.push_back(next);
      factor.conservativeResize(Eigen::NoChange, factor.cols() + 1);
      factor.rightCols<1>() = column;
      rest -= column.cwiseAbs2();
    }
  }
};

} // namespace

ShortMotion short_motion(const Eigen::MatrixXd &motion, double tolerance)
{
  ShortMotion result;
  if (motion.size() == 0 || motion.colwise().norm().maxCoeff() <= tolerance)
    return result;
  const Eigen::MatrixXd  gram = motion.transpose() * motion;
  const SpanningInstants spanning(gram, tolerance);
  const Eigen::MatrixXd &weights = spanning.factor;
  const auto             rank    = weights.cols();
  Eigen::MatrixXd        basis(motion.rows(), rank), corner(rank, rank);
  for (Eigen::Index r = 0; r < rank; ++r)
  {
    basis.col(r)  = motion.col(spanning.taken[std::size_t(r)]);
    corner.row(r) = weights.row(spanning.taken[std::size_t(r)]);
  }
  corner.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(basis);

  Eigen::MatrixXf scaled = weights.cast<float>();
  for (Eigen::Index r = 0; r < rank; ++r)
  {
    constexpr double          largest_whole = 32767.; // largest 16 bit integer
    const double              unit          = basis.col(r).cwiseAbs().maxCoeff() / largest_whole;
    std::vector<std::int16_t> shape(static_cast<std::size_t>(basis.rows()));
    for (Eigen::Index i = 0; i < basis.rows() && unit > 0.; ++i)
      shape[static_cast<std::size_t>(i)] = static_cast<std::int16_t>(std::lround(basis(i, r) / unit));
    scaled.col(r) *= static_cast<float>(unit);
    result.shapes.push_back(shape);
  }
  for (Eigen::Index k = 0; k < scaled.rows(); ++k)
    for (Eigen::Index r = 0; r < rank; ++r)
      result.weights.push_back(scaled(k, r));
  return result;
}

bool is_straight(const Eigen::MatrixXd &motion, const std::vector<double> &times, double tolerance)
{
  for (Eigen::Index k = 1; k + 1 < motion.cols() && motion.rows() > 0; ++k)
  {
    const double *const   t     = times.data() + k;
    const double          share = t[1] > t[-1] ? (t[0] - t[-1]) / (t[1] - t[-1]) : 0.5;
    const Eigen::VectorXd off   = motion.col(k) - (1. - share) * motion.col(k - 1) - share * motion.col(k + 1);
    if (Eigen::Map<const Eigen::Matrix3Xd>(off.data(), 3, off.size() / 3).colwise().norm().maxCoeff() > tolerance)
      return false;
  }
  return true;
}

} // namespace gestell::apps

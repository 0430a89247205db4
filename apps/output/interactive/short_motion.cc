#include "apps/output/interactive/short_motion.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace gestell::apps
{
namespace
{

/// Number of the largest singular vectors that carry every column u_k of the motion within the tolerance:
/// |u_k|^2 - sum_r lambda_r w_kr^2 is the square of its error, from U^T U = W diag(lambda) W^T, the largest last.
Eigen::Index rank_for(const Eigen::MatrixXd &gram, const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> &vectors,
                      double tolerance)
{
  Eigen::VectorXd squares = gram.diagonal();
  Eigen::Index    rank    = 0;
  while (rank < gram.cols() && (rank == 0 || squares.maxCoeff() > tolerance * tolerance))
  {
    const Eigen::Index r = gram.cols() - ++rank;
    squares -= vectors.eigenvalues()(r) * vectors.eigenvectors().col(r).cwiseAbs2();
  }
  return rank;
}

} // namespace

ShortMotion short_motion(const Eigen::MatrixXd &motion, double tolerance)
{
  ShortMotion result;
  if (motion.size() == 0 || motion.colwise().norm().maxCoeff() <= tolerance)
    return result;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(motion.cols(), motion.cols());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(motion.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> vectors(gram);
  const Eigen::Index                                   rank    = rank_for(gram, vectors, tolerance);
  const Eigen::MatrixXd                                weights = vectors.eigenvectors().rightCols(rank);
  const Eigen::MatrixXd                                basis   = motion * weights;

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

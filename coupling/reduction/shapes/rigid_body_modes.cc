#include "coupling/reduction/shapes/rigid_body_modes.h"

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/integration/system/dense_solvers.h"
#include "fem/assembly/rigid_motions.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr double free_below = 1e-13; // x^T C x / x^T D x
constexpr double shift      = 1e-9;  // C + shift D can be factored whatever is free
constexpr int    candidates = 12;    // a frame in one piece has six rigid motions; a loose part adds six
constexpr int    rounds     = 6;     // of inverse iteration: free motions gain a factor of about 100 in each

/// Columns turned into a basis of their span that is orthonormal in the diagonal inner product D.
MatrixXd orthonormal(const MatrixXd &X, const VectorXd &D)
{
  const VectorXd root = D.cwiseSqrt();
  const MatrixXd Q    = orthonormal_columns(root.asDiagonal() * X, X.cols());
  return root.cwiseInverse().asDiagonal() * Q;
}

/// Motions of least x^T C x / x^T D x, D the diagonal of C, that are free.
MatrixXd energy_free_motions(const SparseMatrix &lower, const VectorXd &D)
{
  SparseMatrix shifted = lower;
  shifted.diagonal() += shift * D;
  const SparseCholesky factor(shifted);

  const int n = int(D.size()), k = std::min(candidates, n);
  MatrixXd  X(n, k);
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < n; ++i)
      X(i, j) = std::fmod(0.6180339887498949 * (i + 1.) * (j + 1.) * (j + 1.), 1.) - 0.5;

  VectorXd quotient;
  for (int round = 0; round < rounds; ++round)
  {
    X = D.asDiagonal() * X;
    factor.solve_in_place(X);
    X                             = orthonormal(X, D);
    const MatrixXd             CX = lower.selfadjointView<Eigen::Lower>() * X;
    const SymmetricEigenSolver ritz(X.transpose() * CX);
    X        = (X * ritz.eigenvectors()).eval();
    quotient = ritz.eigenvalues();
  }
  int n_free = 0;
  while (n_free < k && quotient(n_free) < free_below)
    ++n_free;
  return X.leftCols(n_free);
}

/// Where a free motion is greatest: a coordinate and, where pictures tell it, a point.
std::string place_of(const fem::FrameMatrices &frame, const VectorXd &x)
{
  int coordinate;
  x.cwiseAbs().maxCoeff(&coordinate);
  std::ostringstream text;
  text << "a motion that is greatest at coordinate " << coordinate;
  const VectorXd skin = frame.picture.displacement.rows() > 0 ? VectorXd(frame.picture.displacement * x) : VectorXd();
  if (skin.size() > 0 && skin.cwiseAbs().maxCoeff(&coordinate) > 0.)
  {
    const auto &point = frame.picture.points[coordinate / 3];
    text.precision(3);
    text << ", near (" << point[0] << ", " << point[1] << ", " << point[2] << ") m";
  }
  return text.str();
}

std::string join(const std::vector<std::string> &words)
{
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " and ") + words[i];
  return text;
}

[[noreturn]] void refuse(const std::string &motion)
{
  throw std::invalid_argument("reduction: the frame is free to move while its interface is held (C22 is singular): " +
                              motion + "; support the frame against it, or add an interface that holds it");
}

} // namespace

void require_no_free_motion(const fem::FrameMatrices &frame, const std::vector<int> &q1, const SparseMatrix &C)
{
  const auto rigid = fem::free_motions(frame, q1);
  if (!rigid.empty())
    refuse(join(rigid));

  const VectorXd D = C.diagonal();
  for (int i = 0; i < D.size(); ++i)
    if (!(D(i) > 0.))
      refuse("coordinate " + std::to_string(i) + " has no stiffness at all");
  MatrixXd X;
  try
  {
    X = energy_free_motions(C, D);
  }
  catch (const NotPositiveDefinite &)
  {
    return; // indefinite: no free motion explains it
  }
  if (X.cols() > 0)
    refuse(std::to_string(X.cols()) + (X.cols() == 1 ? " way, " : " ways, one of them ") + place_of(frame, X.col(0)));
}

} // namespace gestell::coupling

#include "coupling/reduction/shapes/fixed_interface_frame.h"

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/factors/make_factor.h"
#include "coupling/factors/petsc_factor.h"
#include "coupling/integration/system/dense_solvers.h"
#include "fem/assembly/rigid_motions.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

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
  SparseMatrix     shifted = lower;
  constexpr double shift   = 1e-9; // C + shift D can be factored whatever is free
  shifted.diagonal() += shift * D;
  const SparseCholesky factor(shifted);

  constexpr int candidates = 12; // a frame in one piece has six rigid motions; a loose part adds six
  const int     n = int(D.size()), k = std::min(candidates, n);
  MatrixXd      X(n, k);
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < n; ++i)
      X(i, j) = std::fmod(0.6180339887498949 * (i + 1.) * (j + 1.) * (j + 1.), 1.) - 0.5;

  VectorXd      quotient;
  constexpr int rounds = 6; // of inverse iteration: free motions grow by about 100 in each
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
  constexpr double free_below = 1e-13; // x^T C x / x^T D x
  int              n_free     = 0;
  while (n_free < k && quotient(n_free) < free_below)
    ++n_free;
  return X.leftCols(n_free);
}

/// The coordinate at which a free motion is largest and, if the frame has a picture, the point.
std::string place_of(const fem::FrameMatrices &frame, const VectorXd &x)
{
  int coordinate;
  x.cwiseAbs().maxCoeff(&coordinate);
  std::ostringstream text;
  text << "a motion that is largest at DOF " << coordinate;
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
  throw std::invalid_argument("reduction: the frame is unconstrained with its interface fixed (C22 is singular): " +
                              motion + "; add a support or an interface that constrains it");
}

/**
 * Throws std::invalid_argument with the motions that C does not resist: in words ("translation along x", see
 * fem::free_motions()), or by the coordinate that moves most if the rigid motions of the frame are unknown. Returns if
 * there are none.
 *
 * A motion x counts as free if  x^T C x < 1e-13 x^T diag(C) x:  rounding of the assembly gives about 1e-16, a machine
 * on soft springs some 1e-10.
 *
 * @param C  lower triangle of the stiffness with the interface fixed [n x n].
 */
void require_no_free_motion(const fem::FrameMatrices &frame, const std::vector<int> &q1, const SparseMatrix &C)
{
  const auto rigid = fem::free_motions(frame, q1);
  if (!rigid.empty())
    refuse(join(rigid));

  const VectorXd D = C.diagonal();
  for (int i = 0; i < D.size(); ++i)
    if (!(D(i) > 0.))
      refuse("DOF " + std::to_string(i) + " has no stiffness");
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

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Ratio of pivots below which a free motion is suspected; frames with sufficient supports stay above it.
constexpr double suspicious_pivots = 1e-11;

/// Lower triangle of C with the rows and columns of q1 replaced by their diagonal: C22, padded.
SparseMatrix lower_triangle_held(const SparseMatrix &C, const std::vector<int> &q1)
{
  std::vector<char> held(C.rows(), 0);
  for (const int i : q1)
    held[i] = 1;
  Eigen::VectorXi height(C.cols());
  for (int j = 0; j < C.outerSize(); ++j)
  {
    height(j) = 1;
    for (SparseMatrix::InnerIterator c(C, j); c; ++c)
      height(j) += c.row() > j;
  }
  const double typical = std::max(C.diagonal().mean(), 1e-300);
  SparseMatrix lower(C.rows(), C.cols());
  lower.reserve(height);
  for (int j = 0; j < C.outerSize(); ++j)
  {
    lower.insert(j, j) = held[j] ? typical : C.coeff(j, j);
    if (!held[j])
      for (SparseMatrix::InnerIterator c(C, j); c; ++c)
        if (c.row() > j && !held[c.row()])
          lower.insert(c.row(), j) = c.value();
  }
  lower.makeCompressed();
  return lower;
}

/// @throws std::invalid_argument if there are more ranks than cells or, for frames without cells, than coordinates.
void require_work_for_all(int n_ranks, const fem::FrameMatrices &frame)
{
  const int         parts  = frame.n_cells > 0 ? frame.n_cells : int(frame.C.rows());
  const std::string called = frame.n_cells > 0 ? " cells" : " DOFs";
  if (n_ranks > parts)
    throw std::invalid_argument("mpirun: " + std::to_string(n_ranks) + " ranks for a frame of " +
                                std::to_string(parts) + called + ", but each rank needs at least one; start at most " +
                                std::to_string(parts) +
                                ", or use a finer mesh.  A few thousand cells per rank are efficient.");
}

} // namespace

FixedInterfaceFrame::FixedInterfaceFrame(const fem::FrameMatrices &frame, const std::vector<int> &q1,
                                         std::string factor, std::string eigensolver)
    : frame_(frame), q1_(q1), factor_name_(std::move(factor)), eigensolver_(std::move(eigensolver))
{
  require_work_for_all(ranks_of_factors().size(), frame);
  factor_ = factor_of(q1);
  try
  {
    factor_->factorise();
    if (!(factor_->regularity() >= suspicious_pivots))
      require_no_free_motion(frame, q1, lower_triangle_held(frame.C, q1));
  }
  catch (const NotPositiveDefinite &failure)
  {
    require_no_free_motion(frame, q1, lower_triangle_held(frame.C, q1));
    throw std::invalid_argument(
        "reduction: C22, the stiffness of the frame with its interface fixed, is not positive definite" +
        (failure.row >= 0 ? " at DOF " + std::to_string(failure.row) : std::string()) +
        "; it must be symmetric and positive definite");
  }
}

std::unique_ptr<StiffnessFactor> FixedInterfaceFrame::factor_of(const std::vector<int> &held) const
{
  return make_factor(factor_name_, {&frame_.C, &frame_.M, held, nullptr, fem::available_memory()});
}

Inertia FixedInterfaceFrame::below_if_free(double omega)
{
  if (!free_factor_)
    free_factor_ = factor_of({});
  return free_factor_->below(omega);
}

Eigen::MatrixXd FixedInterfaceFrame::constraint_modes() const
{
  Eigen::MatrixXd Psi = Eigen::MatrixXd::Zero(frame_.C.rows(), q1_.size());
  for (std::size_t k = 0; k < q1_.size(); ++k)
    for (SparseMatrix::InnerIterator c(frame_.C, q1_[k]); c; ++c)
      Psi(c.row(), k) = -c.value();
  solve_in_place(Psi);
  for (std::size_t k = 0; k < q1_.size(); ++k)
    Psi(q1_[k], k) = 1.;
  return Psi;
}

} // namespace gestell::coupling

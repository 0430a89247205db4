#include "coupling/reduction/shapes/fixed_interface_frame.h"

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/eigensolvers/exact_product.h"
#include "coupling/factors/make_factor.h"
#include "coupling/factors/petsc_factor.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/reduction/shapes/reduction_basis.h"
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

/// Motions of least x^T C x / x^T D x, D the diagonal of C, that are free with q1 fixed.
MatrixXd energy_free_motions(const SparseMatrix &C, const std::vector<int> &q1, const VectorXd &D)
{
  SparseMatrix     shifted = C;
  constexpr double shift   = 1e-9; // C + shift D can be factored whatever is free
  shifted.diagonal() += shift * D;
  const SparseCholesky factor(shifted, q1, fem::available_memory());

  constexpr int candidates = 12; // a frame in one piece has six rigid motions; a loose part adds six
  const int     n = int(D.size()), k = std::min(candidates, n - int(q1.size()));
  MatrixXd      X(n, k);
  for (int j = 0; j < k; ++j)
    for (int i = 0; i < n; ++i)
      X(i, j) = std::fmod(0.6180339887498949 * (i + 1.) * (j + 1.) * (j + 1.), 1.) - 0.5;
  X(q1, Eigen::all).setZero();

  VectorXd      quotient;
  constexpr int rounds = 6; // of inverse iteration: free motions grow by about 100 in each
  for (int round = 0; round < rounds; ++round)
  {
    X = D.asDiagonal() * X;
    factor.solve_in_place(X);
    X = orthonormal(X, D);
    const SymmetricEigenSolver ritz(X.transpose() * symmetric_product(C, X));
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
 * @throws NotEnoughMemory.
 */
void require_no_free_motion(const fem::FrameMatrices &frame, const std::vector<int> &q1)
{
  const auto rigid = fem::free_motions(frame, q1);
  if (!rigid.empty())
    refuse(join(rigid));

  VectorXd D = frame.C.diagonal();
  D(q1).setConstant(std::max(D.mean(), 1e-300));
  for (int i = 0; i < D.size(); ++i)
    if (!(D(i) > 0.))
      refuse("DOF " + std::to_string(i) + " has no stiffness");
  MatrixXd X;
  try
  {
    X = energy_free_motions(frame.C, q1, D);
  }
  catch (const NotPositiveDefinite &)
  {
    return; // indefinite: no free motion explains it
  }
  if (X.cols() > 0)
    refuse(std::to_string(X.cols()) + (X.cols() == 1 ? " way, " : " ways, one of them ") + place_of(frame, X.col(0)));
}

/// Ratio of pivots below which a free motion is suspected; frames with sufficient supports stay above it.
constexpr double suspicious_pivots = 1e-11;

SparseMatrix columns_of(const SparseMatrix &A, const std::vector<int> &q1)
{
  SparseMatrix columns(A.rows(), q1.size());
  for (std::size_t k = 0; k < q1.size(); ++k)
    columns.col(k) = A.col(q1[k]);
  columns.makeCompressed();
  return columns;
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
                                         std::string factor, std::string eigensolver, fem::FrameMatrices *given)
    : frame_(frame), given_(ranks_of_factors().size() > 1 ? given : nullptr),
      C_{columns_of(frame.C, q1), frame.C.diagonal()}, M_{columns_of(frame.M, q1), frame.M.diagonal()}, q1_(q1),
      factor_name_(std::move(factor)), eigensolver_(std::move(eigensolver))
{
  require_work_for_all(ranks_of_factors().size(), frame);
  const double available = fem::available_memory();
  factor_ = make_factor(factor_name_, given_ ? FactorMatrices{nullptr, nullptr, q1, &given->C, available, &given->M}
                                             : FactorMatrices{&frame.C, &frame.M, q1, nullptr, available});
  try
  {
    factor_->factorise();
    if (factor_->regularity() >= suspicious_pivots)
      return;
    take_back();
    require_no_free_motion(frame, q1);
  }
  catch (const NotPositiveDefinite &failure)
  {
    take_back();
    require_no_free_motion(frame, q1);
    throw std::invalid_argument(
        "reduction: C22, the stiffness of the frame with its interface fixed, is not positive definite" +
        (failure.row >= 0 ? " at DOF " + std::to_string(failure.row) : std::string()) +
        "; it must be symmetric and positive definite");
  }
}

MatrixXd FixedInterfaceFrame::product(Given which, const Eigen::Ref<const MatrixXd> &X) const
{
  if (!given_)
    return symmetric_product(which == Given::C ? frame_.C : frame_.M, X);
  const SparseMatrix &columns = at(which).columns, rows = columns.transpose();
  const MatrixXd      on_q1 = X(q1_, Eigen::all);
  MatrixXd            Y = exact_product(rows, on_q1), lost = -Y;
  exact_product(rows, on_q1, lost); // the rounding of Y, which remains where A22 X2 cancels Y
  factor_->add_product(which, X, Y);
  Y += lost;
  Y(q1_, Eigen::all) = exact_product(columns, X);
  return Y;
}

MatrixXd FixedInterfaceFrame::energy(const MatrixXd &Psi) const
{
  const MatrixXd S = Psi.transpose() * (given_ ? stiffness_times(Psi) : exact_product(frame_.C, Psi));
  return 0.5 * (S + S.transpose());
}

void FixedInterfaceFrame::take_back() const
{
  if (!given_ || given_->C.nonZeros() > 0)
    return;
  for (auto [to, which] : {std::pair(&given_->C, Given::C), std::pair(&given_->M, Given::M)})
  {
    const SparseMatrix                 &columns = at(which).columns;
    SparseMatrix                        beside(columns.rows(), columns.rows()); // rows and columns of q1
    std::vector<Eigen::Triplet<double>> entries;
    for (int k = 0; k < columns.outerSize(); ++k)
      for (SparseMatrix::InnerIterator a(columns, k); a; ++a)
      {
        entries.emplace_back(a.row(), q1_[k], a.value());
        if (!std::binary_search(q1_.begin(), q1_.end(), a.row()))
          entries.emplace_back(q1_[k], a.row(), a.value());
      }
    beside.setFromTriplets(entries.begin(), entries.end());
    *to = SparseMatrix(factor_->taken_back(which) + beside);
  }
}

Inertia FixedInterfaceFrame::below_if_free(double omega)
{
  take_back();
  if (!free_factor_)
    free_factor_ = make_factor(factor_name_, {&frame_.C, &frame_.M, {}, nullptr, fem::available_memory()});
  return free_factor_->below(omega);
}

Eigen::MatrixXd FixedInterfaceFrame::constraint_modes() const
{
  Eigen::MatrixXd Psi = -C_.columns;
  solve_in_place(Psi);
  for (std::size_t k = 0; k < q1_.size(); ++k)
    Psi(q1_[k], k) = 1.;
  return Psi;
}

} // namespace gestell::coupling

#include "coupling/reduction/shapes/fixed_interface_frame.h"

#include "coupling/eigensolvers/slepc/mode_search.h"
#include "coupling/parallel/team_factor.h"
#include "coupling/reduction/shapes/rigid_body_modes.h"
#include "fem/mesh/memory_estimate.h"

#include <algorithm>
#include <string>
#include <utility>

namespace gestell::coupling
{

namespace
{

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Pivots of a frame that is held well do not differ more than this; below it a free motion is looked for.
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

[[noreturn]] void refuse_indefinite(int coordinate)
{
  throw std::invalid_argument("reduction: C22, the stiffness of the frame with its interface held, is not positive "
                              "definite at coordinate " +
                              std::to_string(coordinate) +
                              "; it must be symmetric with positive energy for every motion");
}

std::unique_ptr<SparseCholesky> factor_held(const fem::FrameMatrices &frame, const std::vector<int> &q1)
{
  try
  {
    auto factor = std::make_unique<SparseCholesky>(frame.C, q1, fem::available_memory());
    if (factor->pivot_ratio() < suspicious_pivots)
      require_no_free_motion(frame, q1, lower_triangle_held(frame.C, q1));
    return factor;
  }
  catch (const NotPositiveDefinite &failure)
  {
    require_no_free_motion(frame, q1, lower_triangle_held(frame.C, q1));
    refuse_indefinite(failure.row);
  }
}

void require_work_for_all(int n_ranks, const fem::FrameMatrices &frame)
{
  const int         parts  = frame.n_cells > 0 ? frame.n_cells : int(frame.C.rows());
  const std::string called = frame.n_cells > 0 ? " cells" : " coordinates";
  if (n_ranks > parts)
    throw std::invalid_argument("mpirun: " + std::to_string(n_ranks) + " ranks for a frame of " +
                                std::to_string(parts) + called + ", but each rank needs at least one; start " +
                                std::to_string(parts) +
                                " at most, or mesh more finely.  Some thousand cells per rank are worth the effort.");
}

} // namespace

FixedInterfaceFrame::FixedInterfaceFrame(const fem::FrameMatrices &frame, const std::vector<int> &q1,
                                         std::string eigensolver)
    : frame_(frame), q1_(q1), eigensolver_(std::move(eigensolver)), team_(on_ranks(q1))
{
  factorise();
}

/// None in one process.
/// @throws std::invalid_argument if there are more ranks than cells, or coordinates where there are no cells.
std::unique_ptr<TeamFactor> FixedInterfaceFrame::on_ranks(const std::vector<int> &q1) const
{
  const Team *const team = Team::of_this_run();
  if (!team)
    return nullptr;
  require_work_for_all(team->ranks().size(), frame_);
  return std::make_unique<TeamFactor>(*team, MatricesOnFirst{&frame_.C, &frame_.M, q1});
}

void FixedInterfaceFrame::factorise()
{
  if (!team_)
  {
    factor_ = factor_held(frame_, q1_);
    return;
  }
  const bool positive = team_->factorise();
  if (!positive || !(team_->pivot_ratio() >= suspicious_pivots))
    require_no_free_motion(frame_, q1_, lower_triangle_held(frame_.C, q1_));
  if (!positive)
    refuse_indefinite(team_->failed());
}

FixedInterfaceFrame::~FixedInterfaceFrame() = default;

void FixedInterfaceFrame::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const
{
  if (team_)
    return team_->solve_in_place(X);
  for (const int i : q1_)
    X.row(i).setZero();
  factor_->solve_in_place(X);
}

void FixedInterfaceFrame::release()
{
  if (team_)
    team_->release();
  else
    factor_->release();
}

void FixedInterfaceFrame::restore()
{
  if (team_)
    team_->factorise();
  else if (factor_->released())
    factor_->factorise(frame_.C);
}

Inertia FixedInterfaceFrame::below(double omega) const
{
  if (team_)
    return team_->below(omega);
  return factor_->inertia(frame_.C, frame_.M, omega * omega);
}

Inertia FixedInterfaceFrame::below_if_free(double omega)
{
  if (team_)
  {
    if (!free_team_)
      free_team_ = on_ranks({});
    return free_team_->below(omega);
  }
  if (!free_factor_)
    free_factor_ = std::make_unique<SparseCholesky>(SparseCholesky::without_numbers(frame_.C, {}));
  return free_factor_->inertia(frame_.C, frame_.M, omega * omega);
}

std::unique_ptr<ModeSearch> FixedInterfaceFrame::search(const BlockLanczos::Options &options,
                                                        const LowestModes           &known) const
{
  if (team_)
    return team_->search(eigensolver_, options, known);
  return search_modes(MPI_COMM_SELF, {std::make_shared<InverseByFactor>(*factor_, q1_), &frame_.M, &frame_.C},
                      eigensolver_, options, known);
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

#include "coupling/reduction/held_frame.h"

#include "coupling/reduction/free_motion.h"
#include "coupling/reduction/team_held_frame.h"
#include "coupling/reduction/team_search.h"
#include "fem/memory_estimate.h"

#include <algorithm>

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

[[noreturn]] void refuse_indefinite(const std::string &where)
{
  throw std::invalid_argument("reduction: C22, the stiffness of the frame with its interface held, is not positive "
                              "definite" +
                              where + "; it must be symmetric with positive energy for every motion");
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
    refuse_indefinite(" at coordinate " + std::to_string(failure.row));
  }
}

std::unique_ptr<TeamHeldFrame> held_by_team(const Team &team, const fem::FrameMatrices &frame,
                                            const std::vector<int> &q1, const fem::RowsOnRanks *rows)
{
  auto held = std::make_unique<TeamHeldFrame>(team, frame, q1, rows);
  if (!held->positive() || !(held->softest() >= suspicious_pivots))
    require_no_free_motion(frame, q1, lower_triangle_held(frame.C, q1));
  if (!held->positive())
    refuse_indefinite("");
  return held;
}

} // namespace

HeldFrame::HeldFrame(const fem::FrameMatrices &frame, const std::vector<int> &q1, const fem::RowsOnRanks *rows)
    : frame_(frame), q1_(q1), rows_(rows)
{
  if (const Team *team = Team::of_this_run())
    team_ = held_by_team(*team, frame, q1, rows);
  else
    factor_ = factor_held(frame, q1);
}

HeldFrame::~HeldFrame() = default;

void HeldFrame::solve_in_place(Eigen::Ref<Eigen::MatrixXd> X) const
{
  if (team_)
    return team_->solve_in_place(X);
  for (const int i : q1_)
    X.row(i).setZero();
  factor_->solve_in_place(X);
}

void HeldFrame::release()
{
  if (factor_)
    factor_->release();
}

void HeldFrame::restore()
{
  if (factor_ && factor_->released())
    *factor_ = SparseCholesky(frame_.C, q1_);
}

Inertia HeldFrame::below(double omega) const
{
  if (team_)
    return {team_->modes_below(omega), 1.};
  return factor_->inertia(frame_.C, frame_.M, omega * omega);
}

Inertia HeldFrame::below_if_free(double omega)
{
  if (team_)
  {
    if (!free_team_)
      free_team_ = std::make_unique<TeamHeldFrame>(*Team::of_this_run(), frame_, std::vector<int>(), rows_);
    return {free_team_->modes_below(omega), 1.};
  }
  if (!free_factor_)
    free_factor_ = std::make_unique<SparseCholesky>(SparseCholesky::without_numbers(frame_.C, {}));
  return free_factor_->inertia(frame_.C, frame_.M, omega * omega);
}

std::unique_ptr<ModeSearch> HeldFrame::search(const BlockLanczos::Options &options, const LowestModes &known) const
{
  if (team_)
    return std::make_unique<TeamSearch>(*team_, known);
  return std::make_unique<BlockLanczos>(frame_.M, std::make_unique<InverseByFactor>(*factor_, q1_), options, known);
}

Eigen::MatrixXd HeldFrame::constraint_modes() const
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

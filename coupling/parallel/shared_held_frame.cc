#include "coupling/parallel/shared_held_frame.h"

#include "coupling/parallel/matrix_graph.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

constexpr int block_width = 32; // columns solved together
constexpr int rounds      = 3;  // of inverse iteration towards the softest motion

} // namespace

SharedHeldFrame::SharedHeldFrame(std::shared_ptr<const SharedMatrices> matrices, const std::vector<int> *q1)
    : matrices_(std::move(matrices)), q1_(q1 ? *q1 : std::vector<int>()), held_(matrices_->rows_of(q1)),
      free_load_(matrices_->vector())
{
  {
    const MatrixGraph graph(matrices_->ranks(), matrices_->C(), held_);
    matrices_->ranks().agree(
        [&]
        {
          if (matrices_->ranks().first())
            places_ = graph.elimination_places();
        });
  }
  factorise();
  if (positive_)
    measure_softest();
}

void SharedHeldFrame::factorise()
{
  if (factor_)
    return;
  factor_ =
      std::make_unique<MumpsFactor>(MumpsFactor::Shifted{matrices_->C()}, held_, places_, MumpsFactor::Sign::positive);
  positive_ = !factor_->failed() && factor_->negative_pivots() == 0;
}

int SharedHeldFrame::modes_below(double omega)
{
  matrices_->ranks().broadcast(omega);
  factor_.reset();
  const MumpsFactor factor({matrices_->C(), matrices_->M(), -omega * omega}, held_, places_,
                           MumpsFactor::Sign::indefinite);
  if (factor.failed())
    throw fem::AgreedFailure(fem::AgreedFailure::Kind::method,
                             "modes cannot be counted: C - omega^2 M is singular at omega = " + std::to_string(omega) +
                                 " rad/s; ask for another number of modes");
  return factor.negative_pivots();
}

void SharedHeldFrame::solve(Vec f, Vec x)
{
  PetscScalar *values = nullptr;
  require_petsc(VecCopy(f, free_load_.get()), "SharedHeldFrame");
  require_petsc(VecGetArray(free_load_.get(), &values), "SharedHeldFrame");
  for (const int row : held_)
    if (row >= matrices_->first_row() && row < matrices_->last_row())
      values[row - matrices_->first_row()] = 0.;
  require_petsc(VecRestoreArray(free_load_.get(), &values), "SharedHeldFrame");
  factor_->solve(free_load_.get(), x);
}

/// C22^-1 M22 x, with a share of every mode that the held interface allows; x is irregular, but always the same.
PetscOwned<Vec> SharedHeldFrame::irregular_motion()
{
  PetscOwned<Vec>       x      = matrices_->vector();
  const PetscOwned<Vec> f      = matrices_->vector();
  PetscScalar          *values = nullptr;
  require_petsc(VecGetArray(x.get(), &values), "SharedHeldFrame");
  for (int i = matrices_->first_row(); i < matrices_->last_row(); ++i)
    values[i - matrices_->first_row()] = std::fmod(0.6180339887498949 * double(i + 1), 1.) - 0.3;
  require_petsc(VecRestoreArray(x.get(), &values), "SharedHeldFrame");
  require_petsc(MatMult(matrices_->M(), x.get(), f.get()), "SharedHeldFrame");
  solve(f.get(), x.get());
  return x;
}

void SharedHeldFrame::measure_softest()
{
  const PetscOwned<Vec> x = irregular_motion(), f = matrices_->vector(), D = matrices_->vector();
  require_petsc(MatGetDiagonal(matrices_->C(), D.get()), "SharedHeldFrame");
  for (int round = 0; round < rounds; ++round)
  {
    VecPointwiseMult(f.get(), D.get(), x.get());
    double norm = 0.;
    VecNorm(f.get(), NORM_2, &norm);
    VecScale(f.get(), 1. / norm);
    solve(f.get(), x.get());
  }
  double energy = 0., scale = 0.;
  require_petsc(MatMult(matrices_->C(), x.get(), f.get()), "SharedHeldFrame");
  VecDot(x.get(), f.get(), &energy);
  VecPointwiseMult(f.get(), D.get(), x.get());
  VecDot(x.get(), f.get(), &scale);
  softest_ = energy / scale;
}

void SharedHeldFrame::solve_in_place(Eigen::Ref<MatrixXd> X)
{
  const fem::Ranks       &ranks   = matrices_->ranks();
  const std::vector<int> &row_of  = matrices_->row_of();
  const int               n       = int(row_of.size()); // none but on rank 0
  int                     columns = int(X.cols());
  ranks.broadcast(columns);
  factorise();
  MatrixXd block;
  for (int first = 0; first < columns; first += block_width)
  {
    const int width = std::min(block_width, columns - first);
    ranks.agree(
        [&]
        {
          block.resize(n, width);
          for (int j = 0; j < width; ++j)
          {
            for (int i = 0; i < n; ++i)
              block(row_of[i], j) = X(i, first + j);
            for (const int i : q1_)
              block(row_of[i], j) = 0.;
          }
        });
    factor_->solve_on_first(block.data(), width);
    for (int j = 0; j < width; ++j)
      for (int i = 0; i < n; ++i)
        X(i, first + j) = block(row_of[i], j);
  }
}

} // namespace gestell::coupling

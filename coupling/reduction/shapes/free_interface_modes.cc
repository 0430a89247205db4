#include "coupling/reduction/shapes/free_interface_modes.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/eigensolvers/slepc/mode_search.h"
#include "coupling/integration/system/convergence_failure.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/reduction/shapes/interface_flexibility.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Circular frequency up to which modes are kept; infinite if their number is given or too few modes are known.
double highest_kept(const ReductionOptions &options, const VectorXd &omega)
{
  if (options.n_modes >= 0)
    return INFINITY;
  if (options.frequency > 0.)
    return reach_of_basis * two_pi * options.frequency;
  return omega.size() >= elastic_of_interest ? reach_of_basis * omega[elastic_of_interest - 1] : INFINITY;
}

/// Finds `most` modes, or fewer if one exceeds the highest frequency to be kept.
void find_enough(FreeInterfaceModes &modes, const ReductionOptions &options, int most)
{
  constexpr int modes_at_once = 20; // step of the search
  for (int count = options.n_modes >= 0 ? most : std::min(modes_at_once, most);;
       count     = std::min(count + modes_at_once, most))
  {
    modes.find(count);
    const VectorXd omega = modes.lowest(count).omega;
    if (count == most || omega[count - 1] > highest_kept(options, omega))
      return;
  }
}

} // namespace

FreeInverse::FreeInverse(const FixedInterfaceFrame &held, const ReductionBasis &basis, const fem::FrameMatrices &frame)
    : held_(held), Psi_(basis.T), S_inverse_(0, 0), R_(basis.T.rows(), 0)
{
  const MatrixXd S = reduced_matrices(basis, frame.B).C;
  R_               = motions_without_stiffness(S, basis, frame);
  S_inverse_       = inverse_beside(S, R_(basis.q1, Eigen::all));
  if (R_.cols() > 0)
  {
    const SymmetricEigenSolver mass(R_.transpose() * held.mass_times(R_));
    R_ *= mass.eigenvectors() * mass.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal();
  }
  MR_ = held.mass_times(R_);
}

void FreeInverse::operator()(Eigen::Ref<MatrixXd> X) const
{
  X -= MR_ * MatrixXd(R_.transpose() * X);
  const MatrixXd on_q1 = S_inverse_ * (Psi_.transpose() * X);
  held_.solve_in_place(X);
  X += Psi_ * on_q1;
  X -= R_ * MatrixXd(MR_.transpose() * X);
}

FreeInterfaceModes::FreeInterfaceModes(FixedInterfaceFrame &held, const ReductionBasis &basis,
                                       const fem::FrameMatrices &frame, const BlockLanczos::Options &options)
    : SturmCheckedModes("elastic modes with the interface free", int(frame.M.rows()) <= dense_limit, options,
                        held.stiffness_diagonal()),
      held_(held), frame_(frame), inverse_(held, basis, frame)
{
  held.take_back(); // rank 0 searches
}

int FreeInterfaceModes::n() const
{
  return int(frame_.M.rows());
}

LowestModes FreeInterfaceModes::all() const
{
  const DenseModes modes = dense_modes(MatrixXd(frame_.C), MatrixXd(frame_.M));
  const auto       k     = modes.omega.size() - n_rigid();
  return {modes.omega.tail(k), modes.V.rightCols(k), VectorXd::Zero(k)};
}

Inertia FreeInterfaceModes::below(double omega)
{
  Inertia inertia = held_.below_if_free(omega);
  inertia.negative -= n_rigid();
  return inertia;
}

std::unique_ptr<ModeSearch> FreeInterfaceModes::search(const BlockLanczos::Options &options,
                                                       const LowestModes           &known) const
{
  auto inverse = std::make_shared<InverseByColumns>(n(), [this](Eigen::Ref<MatrixXd> X) { inverse_(X); });
  return search_modes(MPI_COMM_SELF, {std::move(inverse), &frame_.M, &frame_.C}, held_.eigensolver(), options, known);
}

FreeModes free_modes(const ReductionBasis &basis, FixedInterfaceFrame &held, const fem::FrameMatrices &frame,
                     const ReductionOptions &options)
{
  FreeInterfaceModes modes(held, basis, frame);
  const int          elastic = int(frame.M.rows()) - modes.n_rigid();
  int                most    = options.n_modes >= 0 ? std::min(options.n_modes, elastic) : elastic;
  if (modes.dense() && options.n_modes < 0)
  {
    modes.find(0); // all there are, fewer if masses are missing
    most = std::min<int>(most, modes.found().omega.size());
  }
  // of finding modes that were missing: one suffices, unless a search misses some again
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round)
  {
    find_enough(modes, options, most);
    modes.finish();
    if (!modes.confirm())
      continue;
    const VectorXd &omega = modes.found().omega;
    const auto      kept  = std::min<Eigen::Index>(most, (omega.array() <= highest_kept(options, omega)).count());
    FreeModes       result{omega.head(kept), modes.found().V.leftCols(kept), modes.statement(), modes.n_rigid()};
    result.W -= basis.T * MatrixXd(result.W(basis.q1, Eigen::all));
    return result;
  }
  throw ConvergenceFailure(
      "reduction: in " + std::to_string(most_rounds) +
      " rounds some modes with the interface free were missing each time; request another number of modes");
}

} // namespace gestell::coupling

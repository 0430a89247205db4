#include "coupling/reduction/inner_shapes.h"

#include "coupling/dense_modes.h"
#include "coupling/reduction/lowest_modes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double two_pi          = 6.283185307179586;
constexpr double rounding        = 1e-6;  // size of a shape beside what it was made from
constexpr double cancelled       = 1e-10; // as in supported_modes()
constexpr double singular        = 1e-11; // eigenvalue of S scaled to unit diagonal, below which a motion is rigid
constexpr int    modes_at_once   = 20;
constexpr int    default_elastic = 12;  // modes of interest if no frequency is given
constexpr double reach           = 1.5; // highest mode over the highest frequency of interest
constexpr int    dense_limit     = 600; // coordinates that are solved densely

VectorXd mass_of(const MatrixXd &W, const MatrixXd &MW)
{
  return (W.array() * MW.array()).colwise().sum();
}

/// C^+ of the frame with its interface free, on loads in balance:  x = (0; C22^-1 f2) + Psi S^+ Psi^T f,  x^T M R = 0.
class FreeInverse
{
public:
  FreeInverse(const HeldFrame &held, const ReductionBasis &basis, const fem::FrameMatrices &frame)
      : held_(held), Psi_(basis.T), S_inverse_(0, 0), R_(basis.T.rows(), 0)
  {
    const ReducedMatrices star = reduced_matrices(basis, frame.B, frame.C);
    const MatrixXd       &S    = star.C;
    if (S.rows() > 0)
    {
      const VectorXd d = S.diagonal().unaryExpr([](double s) { return s > 0. ? 1. / std::sqrt(s) : 1.; });
      const Eigen::SelfAdjointEigenSolver<MatrixXd> scaled(d.asDiagonal() * S * d.asDiagonal());
      const VectorXd                                inverse =
          scaled.eigenvalues().unaryExpr([](double lambda) { return lambda > singular ? 1. / lambda : 0.; });
      const MatrixXd U = d.asDiagonal() * scaled.eigenvectors();
      S_inverse_       = U * inverse.asDiagonal() * U.transpose();
      if (const auto n_rigid = (inverse.array() == 0.).count(); n_rigid > 0)
      {
        const MatrixXd                                on_q1 = U.leftCols(n_rigid);
        const Eigen::SelfAdjointEigenSolver<MatrixXd> mass(on_q1.transpose() * star.M * on_q1);
        R_ = Psi_ * (on_q1 * mass.eigenvectors() * mass.eigenvalues().cwiseSqrt().cwiseInverse().asDiagonal());
      }
    }
    MR_ = symmetric_product(frame.M, R_);
  }

  const MatrixXd &rigid() const { return R_; }

  void operator()(Eigen::Ref<MatrixXd> X) const
  {
    X -= MR_ * MatrixXd(R_.transpose() * X);
    const MatrixXd on_q1 = S_inverse_ * (Psi_.transpose() * X);
    held_.solve_in_place(X);
    X += Psi_ * on_q1;
    X -= R_ * MatrixXd(MR_.transpose() * X);
  }

private:
  const HeldFrame &held_;
  const MatrixXd  &Psi_;
  MatrixXd         S_inverse_, R_, MR_;
};

/// All elastic modes of few coordinates.
LowestModes dense_free_modes(const fem::FrameMatrices &frame, Eigen::Index n_rigid)
{
  const DenseModes modes = dense_modes(MatrixXd(frame.C), MatrixXd(frame.M));
  const auto       k     = modes.omega.size() - n_rigid;
  return {modes.omega.tail(k), modes.V.rightCols(k), VectorXd::Zero(k)};
}

/// Circular frequency up to which modes are kept, infinite if their number is given or there are too few to tell.
double highest_kept(const ReductionOptions &options, const VectorXd &omega)
{
  if (options.n_modes >= 0)
    return INFINITY;
  if (options.frequency > 0.)
    return reach * two_pi * options.frequency;
  return omega.size() >= default_elastic ? reach * omega[default_elastic - 1] : INFINITY;
}

/// As many as are asked for, or until one lies above the highest that is to be kept.
LowestModes searched_free_modes(const fem::FrameMatrices &frame, const FreeInverse &inverse,
                                const ReductionOptions &options, Eigen::Index most)
{
  if (most == 0)
    return {VectorXd(0), MatrixXd(frame.M.rows(), 0), VectorXd(0)};
  BlockLanczos search(
      frame.M, std::make_unique<InverseByColumns>(int(frame.M.rows()), [&](Eigen::Ref<MatrixXd> X) { inverse(X); }),
      {});
  for (auto count = options.n_modes >= 0 ? most : std::min<Eigen::Index>(modes_at_once, most);;
       count      = std::min<Eigen::Index>(count + modes_at_once, most))
  {
    search.find(int(count));
    LowestModes modes = search.modes(int(count));
    if (count == most || modes.omega[count - 1] > highest_kept(options, modes.omega))
      return modes;
  }
}

} // namespace

int append_shapes(ReductionBasis &basis, const fem::FrameMatrices &frame, MatrixXd W)
{
  if (W.cols() == 0)
    return 0;
  const VectorXd size = mass_of(W, symmetric_product(frame.M, W)).cwiseSqrt();
  W *= size.unaryExpr([](double s) { return s > 0. ? 1. / s : 0.; }).asDiagonal();
  const MatrixXd M_modes = symmetric_product(frame.M, basis.fixed_modes());
  for (int again = 0; again < 2; ++again)
    W -= basis.fixed_modes() * (M_modes.transpose() * W);

  const Eigen::SelfAdjointEigenSolver<MatrixXd> mass(W.transpose() * symmetric_product(frame.M, W));
  const auto                                    dropped = (mass.eigenvalues().array() <= rounding * rounding).count();
  const auto                                    kept    = W.cols() - dropped;
  if (kept == 0)
    return 0;
  W = W * mass.eigenvectors().rightCols(kept) * mass.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();

  const Eigen::SelfAdjointEigenSolver<MatrixXd> stiffness(W.transpose() * symmetric_product(frame.C, W));
  MatrixXd                                      V(W.rows(), basis.m() + kept);
  VectorXd                                      omega(basis.m() + kept);
  V << basis.fixed_modes(), W * stiffness.eigenvectors();
  omega << basis.omega0, stiffness.eigenvalues().cwiseSqrt();
  basis.set_modes(V, omega);
  return int(kept);
}

MatrixXd inertia_relief_shapes(const HeldFrame &held, const fem::FrameMatrices &frame, const std::vector<int> &q1)
{
  MatrixXd load(frame.M.rows(), 0);
  if (frame.rigid_motions.cols() == 6)
    load = symmetric_product(frame.M, frame.rigid_motions);
  else if (frame.translations.rows() > 0)
    load = symmetric_product(frame.M, frame.translations);
  if (frame.acceleration_load.rows() > 0 && load.cols() >= 3)
    load.leftCols(3) = frame.acceleration_load; // weight, exactly so at clamped supports too
  held.solve_in_place(load);
  for (const int i : q1)
    load.row(i).setZero();
  return load;
}

SupportedModes ritz_modes(const ReducedMatrices &star)
{
  const DenseModes ritz = dense_modes(star.C, star.M, cancelled);
  SupportedModes   modes;
  modes.n_rigid      = int((ritz.omega.array() == 0.).count());
  const auto elastic = ritz.omega.size() - modes.n_rigid;
  modes.omega        = ritz.omega.tail(elastic);
  modes.P            = star.M * ritz.V.rightCols(elastic);
  return modes;
}

FreeModes free_modes(const ReductionBasis &basis, const HeldFrame &held, const fem::FrameMatrices &frame,
                     const ReductionOptions &options)
{
  const FreeInverse inverse(held, basis, frame);
  const auto        n = basis.T.rows(), elastic = n - inverse.rigid().cols();
  const auto        most  = options.n_modes >= 0 ? std::min<Eigen::Index>(options.n_modes, elastic) : elastic;
  LowestModes       found = n <= dense_limit ? dense_free_modes(frame, inverse.rigid().cols())
                                             : searched_free_modes(frame, inverse, options, most);
  const auto        kept  = std::min(most, (found.omega.array() <= highest_kept(options, found.omega)).count());
  FreeModes         modes{found.omega.head(kept), found.V.leftCols(kept)};
  modes.W -= basis.T * MatrixXd(modes.W(basis.q1, Eigen::all));
  return modes;
}

} // namespace gestell::coupling

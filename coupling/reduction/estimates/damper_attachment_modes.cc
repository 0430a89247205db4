#include "coupling/reduction/estimates/damper_attachment_modes.h"

#include "coupling/integration/system/dense_solvers.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <complex>

namespace gestell::coupling
{

namespace
{

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

enum Kind
{
  in_C,
  in_M,
  in_B
};

/// Indices of the interleaved columns of one kind that belong to `count` columns of T from `first` on.
auto of(Kind kind, Index first, Index count)
{
  return Eigen::seqN(3 * first + Index(kind), count, Eigen::fix<3>);
}

/// The model T = (Psi, V, W) and the Gramian of its residual forces F = (C T2, M T, B T)_2 in interleaved columns; T2 =
/// (0, V, W), because Psi is in equilibrium.
class DampedModel
{
public:
  DampedModel(const FixedInterfaceFrame &held, const ReductionBasis &basis, double highest, int m,
              const fem::FrameMatrices &frame)
      : held_(held), basis_(basis), frame_(frame), n1_(basis.n1()), fixed_(n1_ + m), W_(frame.M.rows(), 0),
        slowest_beyond_(std::pow(highest, -2))
  {
    extend(fixed_);
    scale_ = M_.diagonal().head(n1_).unaryExpr([](double x) { return x > 0. ? 1. / std::sqrt(x) : 1.; });
  }

  /// Appends the part of shapes (zero on q1) that is new and has mass.
  /// @return the number of shapes appended
  Index append(MatrixXd W)
  {
    const auto mass = [&] { return MatrixXd(W.transpose() * held_.mass_times(W)); };
    W *= mass().diagonal().unaryExpr([](double s) { return s > 0. ? 1. / std::sqrt(s) : 0.; }).asDiagonal();
    const auto V = basis_.T.middleCols(n1_, fixed_ - n1_);
    for (int again = 0; again < 2; ++again)
    {
      const MatrixXd MW = held_.mass_times(W);
      W -= V * (V.transpose() * MW);
      W -= W_ * (W_.transpose() * MW);
    }
    const SymmetricEigenSolver left(mass());
    constexpr double           rounding = 1e-12; // of the mass of a shape before projection
    const Index                kept     = (left.eigenvalues().array() > rounding).count();
    W_.conservativeResize(Eigen::NoChange, W_.cols() + kept);
    W_.rightCols(kept) =
        W * left.eigenvectors().rightCols(kept) * left.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse().asDiagonal();
    extend(kept);
    return kept;
  }

  const MatrixXd &shapes() const { return W_; }

  struct Answer
  {
    MatrixXcd c;          // F c is unbalanced, the interface moved by E
    MatrixXcd H_model, H; // scaled; of the full frame as it is estimated
    double    error = 0.; // |H_model - H| / |H|
  };

  Answer at(const ReceptanceFrequency &frequency) const
  {
    const double    omega = frequency.omega;
    const Complex   kappa(1., 2. * frequency.ratio), i_omega(0., omega);
    const Index     n = size(), n2 = n - n1_;
    const MatrixXcd D = kappa * C_ - omega * omega * M_ + i_omega * B_;
    MatrixXcd       p(n, n1_);
    p << MatrixXcd::Identity(n1_, n1_), -D.bottomRightCorner(n2, n2).partialPivLu().solve(D.bottomLeftCorner(n2, n1_));
    Answer answer;
    answer.c.resize(3 * n, n1_);
    answer.c(of(in_C, 0, size()), Eigen::all) = kappa * p;
    answer.c(of(in_M, 0, size()), Eigen::all) = -omega * omega * p;
    answer.c(of(in_B, 0, size()), Eigen::all) = i_omega * p;

    const MatrixXcd z       = Q_ * answer.c;
    const VectorXcd flex    = (kappa * basis_.omega0.array().square()).inverse().matrix();
    const VectorXcd full    = (kappa * basis_.omega0.array().square() - omega * omega).inverse().matrix();
    const MatrixXcd rest    = answer.c.transpose() * (G_ * answer.c) / kappa - z.transpose() * flex.asDiagonal() * z;
    const MatrixXcd lacking = rest / (1. - omega * omega * slowest_beyond_) + z.transpose() * full.asDiagonal() * z;
    const MatrixXcd model   = D.topRows(n1_) * p;
    const auto      inverse = [&](const MatrixXcd &A)
    { return MatrixXcd((scale_.asDiagonal() * A * scale_.asDiagonal()).partialPivLu().inverse()); };
    answer.H       = inverse(model - lacking);
    answer.H_model = inverse(model);
    answer.error   = relative_error(answer.H_model, answer.H);
    return answer;
  }

  /// C22^-1 F c in its principal directions under unit forces on the interface, without T2, which is known.
  MatrixXd principal_shapes(const Answer &answer, double tolerance, Index most) const
  {
    const MatrixXcd forced = answer.c * (scale_.asDiagonal() * answer.H);
    MatrixXd        parts(forced.rows(), 2 * n1_);
    parts << forced.real(), forced.imag();
    const SymmetricEigenSolver energy(parts.transpose() * G_ * parts);
    constexpr double           share = 0.5; // of the tolerance, left to directions that get no shape
    Index                      kept  = 1;   // the trace bounds |H r^T C22^-1 r H|
    while (kept < 2 * n1_ && energy.eigenvalues().head(2 * n1_ - kept).sum() > share * tolerance * answer.H.norm())
      ++kept;
    const MatrixXd a = parts * energy.eigenvectors().rightCols(std::min(kept, most));
    MatrixXd       Y = held_.mass_times(expand(a(of(in_M, 0, size()), Eigen::all))) +
                 symmetric_product(frame_.B, expand(a(of(in_B, 0, size()), Eigen::all)));
    held_.solve_in_place(Y);
    return Y;
  }

private:
  Index size() const { return fixed_ + W_.cols(); }

  MatrixXd expand(const MatrixXd &a) const // T a
  {
    return basis_.T.leftCols(fixed_) * a.topRows(fixed_) + W_ * a.bottomRows(W_.cols());
  }

  MatrixXd project(const MatrixXd &Y) const // T^T Y
  {
    MatrixXd result(size(), Y.cols());
    result << basis_.T.leftCols(fixed_).transpose() * Y, W_.transpose() * Y;
    return result;
  }

  MatrixXd inside(MatrixXd Y) const
  {
    for (const int i : basis_.q1)
      Y.row(i).setZero();
    return Y;
  }

  /// Adds what belongs to the last columns of T.
  void extend(Index columns)
  {
    const Index n = size();
    for (MatrixXd *A : {&M_, &B_, &C_})
      A->conservativeResize(n, n);
    G_.conservativeResize(3 * n, 3 * n);
    Q_.conservativeResize(basis_.m(), 3 * n);
    constexpr Index chunk = 16; // columns solved for at a time, as blocks of the factor
    for (Index j = n - columns; j < n; j += chunk)
      extend(j, std::min(chunk, n - j));
  }

  void extend(Index j, Index k)
  {
    const auto symmetric = [](MatrixXd &A, const auto &at, const auto &rows, const MatrixXd &columns)
    {
      A(rows, at) = columns;
      A(at, rows) = columns.transpose();
    };
    MatrixXd unit = MatrixXd::Identity(size(), size()).middleCols(j, k);
    MatrixXd t = expand(unit), F[] = {{}, held_.mass_times(t), symmetric_product(frame_.B, t)};
    symmetric(M_, Eigen::seqN(j, k), Eigen::all, project(F[in_M]));
    symmetric(B_, Eigen::seqN(j, k), Eigen::all, project(F[in_B]));
    symmetric(C_, Eigen::seqN(j, k), Eigen::all, project(held_.stiffness_times(t)));
    unit.topRows(n1_).setZero();
    t       = expand(unit); // of T2
    F[in_C] = held_.stiffness_times(t);
    for (const Kind kind : {in_C, in_M, in_B})
    {
      MatrixXd   Y       = inside(std::move(F[kind]));
      const auto at      = of(kind, j, k);
      Q_(Eigen::all, at) = basis_.fixed_modes().transpose() * Y;
      MatrixXd on_T2     = project(Y); // T2^T C22 C22^-1 F
      on_T2.topRows(n1_).setZero();
      if (kind == in_C)
        Y = t;
      else
        held_.solve_in_place(Y);
      symmetric(G_, at, of(in_C, 0, size()), on_T2);
      symmetric(G_, at, of(in_M, 0, size()), project(held_.mass_times(Y)));
      symmetric(G_, at, of(in_B, 0, size()), project(symmetric_product(frame_.B, Y)));
    }
  }

  const FixedInterfaceFrame &held_;
  const ReductionBasis      &basis_; // with all modes known
  const fem::FrameMatrices  &frame_;
  Index                      n1_, fixed_; // columns of Psi; and of V
  MatrixXd                   W_;
  double                     slowest_beyond_; // largest 1 / omega0^2 [s^2] of modes that are not known
  VectorXd                   scale_;
  MatrixXd                   M_, B_, C_; // T^T M T, ..
  MatrixXd                   G_, Q_;     // F^T C22^-1 F; (all modes)^T F
};

} // namespace

bool has_inner_dampers(const ReductionBasis &basis, const Eigen::SparseMatrix<double> &B)
{
  for (Index j = 0; j < B.outerSize(); ++j)
    if (!std::binary_search(basis.q1.begin(), basis.q1.end(), int(j)))
      for (Eigen::SparseMatrix<double>::InnerIterator entry(B, j); entry; ++entry)
        if (entry.value() != 0.)
          return true;
  return false;
}

DamperAttachmentModes damper_attachment_modes(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame,
                                              const ModelOfModes &modes, const ReceptanceGoal &goal)
{
  DampedModel model(held, modes.basis, modes.highest, modes.m, frame);
  if (modes.X.cols() > 0)
    model.append(modes.X);
  DamperAttachmentModes result;
  Index                 shapes = 0;
  for (;;)
  {
    DampedModel::Answer worst;
    result.of_groups.clear();
    for (const ReceptanceFrequency &frequency : goal.frequencies)
    {
      auto answer = model.at(frequency);
      raise_errors(goal.groups, answer.H_model, answer.H, result.of_groups);
      if (answer.error >= worst.error)
        worst = std::move(answer);
    }
    result.left = worst.error;
    if (worst.error <= goal.tolerance || shapes >= goal.most || !std::isfinite(worst.error))
      break;
    const Index added = model.append(model.principal_shapes(worst, goal.tolerance, goal.most - shapes));
    result.exhausted  = added == 0;
    if (result.exhausted)
      break;
    shapes += added;
  }
  result.W = model.shapes().rightCols(shapes);
  return result;
}

} // namespace gestell::coupling

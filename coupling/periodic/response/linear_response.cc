#include "coupling/periodic/response/linear_response.h"

#include "coupling/integration/system/turning_forces.h"
#include "coupling/periodic/response/linearised_system.h"
#include "coupling/periodic/response/unstable_modes.h"

#include <Eigen/LU>

#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Complex = std::complex<double>;
using Long    = std::complex<long double>;
using LongXcd = Eigen::Matrix<Long, Eigen::Dynamic, Eigen::Dynamic>;

/// F, and what the equations of the measures and of E have on their right-hand side.
template <typename Matrix>
struct Unknowns
{
  Matrix q, p, mu; ///< [n], [n_u], [n_e] rows
};

using Solution = Unknowns<MatrixXcd>;
using Residual = Unknowns<LongXcd>;

/// D(w) of the elements at a motion.
void linearise_elements(const SecondOrderSystem &system, const LocalState &at, LinearisedSystem &own)
{
  const Index     n_u = own.n_u();
  Eigen::VectorXd p   = Eigen::VectorXd::Zero(n_u);
  for (MatrixXd *part : {&own.K_u, &own.B_u, &own.M_u})
    part->setZero(n_u, n_u);
  linearise(system.forces(), at, p, own.K_u, own.B_u);
  system.forces().tangent(at, 0., 0., 1., p, own.M_u);
  for (MatrixXd *part : {&own.K_u, &own.B_u, &own.M_u})
    *part = -*part;
}

/// E = [G; rows of what sticks] [n_e x n_u]
MatrixXd bound_motions(const SecondOrderSystem &system, const LocalState &at)
{
  const Index        n_u = system.forces().directions().cols(), n_c = system.joints().n_rows();
  const auto        &held = system.forces().held();
  MatrixXd           E    = MatrixXd::Zero(n_c + Index(held.size()), n_u);
  ConstraintJacobian G(system.joints().blocks());
  Eigen::VectorXd    g = Eigen::VectorXd::Zero(n_c);
  if (n_c > 0)
    system.joints().constraints(at, g, G);
  for (std::size_t i = 0; i < G.blocks().size(); ++i)
  {
    const ConstraintBlock &block                                                  = G.blocks()[i];
    E.block(block.first_row, block.first_measure, block.n_rows, block.n_measures) = G[i];
  }
  for (std::size_t i = 0; i < held.size(); ++i)
    E(n_c + Index(i), held[i].measure) = 1.;
  return E;
}

} // namespace

namespace
{

/// The equations solved at one frequency for any right-hand side (f, g, c):
/// A_0 q - W p = f,  p + D u - E^T mu = g,  E u = c,  u = W^T q.
class AtFrequency
{
public:
  virtual ~AtFrequency()                                   = default;
  virtual Solution solve(const Solution &right_hand) const = 0;
};

Residual residual(const LinearisedSystem &of, double omega, const MatrixXd &F, const Solution &x)
{
  const auto    w = static_cast<long double>(omega);
  const LongXcd q = x.q.cast<Long>(), p = x.p.cast<Long>(), mu = x.mu.cast<Long>();
  Residual      r{F.cast<Long>(), LongXcd::Zero(of.n_u(), q.cols()), LongXcd::Zero(of.E.rows(), q.cols())};
  LongXcd       u = LongXcd::Zero(of.n_u(), q.cols());
  for (const auto &[i, j, m, b, c] : of.base)
    r.q.row(i) -= Long(c - w * w * m, w * b) * q.row(j);
  for (Index j = 0; j < of.W.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(of.W, j); entry; ++entry)
    {
      r.q.row(entry.row()) += Long(entry.value()) * p.row(j);
      u.row(j) += Long(entry.value()) * q.row(entry.row());
    }
  r.p = -p;
  for (Index j = 0; j < of.n_u(); ++j)
  {
    for (Index i = 0; i < of.n_u(); ++i)
      if (of.K_u(i, j) != 0. || of.B_u(i, j) != 0. || of.M_u(i, j) != 0.)
        r.p.row(i) -= Long(of.K_u(i, j) - w * w * of.M_u(i, j), w * of.B_u(i, j)) * u.row(j);
    for (Index e = 0; e < of.E.rows(); ++e)
      if (of.E(e, j) != 0.)
      {
        r.p.row(j) += Long(of.E(e, j)) * mu.row(e);
        r.mu.row(e) -= Long(of.E(e, j)) * u.row(j);
      }
  }
  return r;
}

/// By the receptance of the base.
class Condensed final : public AtFrequency
{
public:
  Condensed(const LinearisedSystem &parts, double omega) : parts_(parts), omega_(omega), D_(parts.D(omega))
  {
    driven_ = parts.modes->put().cast<Complex>();
    parts.modes->divide(Complex(0., omega), driven_);
    Y_              = parts.modes->read().transpose() * driven_;
    const Index n_u = parts.n_u(), n_e = parts.E.rows();
    unit_           = Y_.size() > 0 ? Y_.cwiseAbs().maxCoeff() : 1.; // of mu, so that both columns are alike
    MatrixXcd small = MatrixXcd::Zero(n_u + n_e, n_u + n_e);
    small.topLeftCorner(n_u, n_u) = MatrixXcd::Identity(n_u, n_u) + Y_ * D_;
    if (n_e > 0)
    {
      small.topRightCorner(n_u, n_e)   = -Y_ * parts.E.transpose() / unit_;
      small.bottomLeftCorner(n_e, n_u) = parts.E.cast<Complex>();
    }
    if (small.size() > 0)
      lu_.compute(small);
  }

  Solution solve(const Solution &rhs) const override
  {
    const Index n_u = parts_.n_u(), n_e = parts_.E.rows();
    MatrixXcd   x = parts_.modes->G() * rhs.q;
    parts_.modes->divide(Complex(0., omega_), x);
    Solution result{{}, MatrixXcd::Zero(n_u, x.cols()), MatrixXcd::Zero(n_e, x.cols())};
    if (n_u > 0)
    {
      MatrixXcd known(n_u + n_e, x.cols());
      known << parts_.modes->read().transpose() * x + Y_ * rhs.p, rhs.mu;
      const MatrixXcd found = lu_.solve(known);
      result.mu             = found.bottomRows(n_e) / unit_;
      result.p              = rhs.p - D_ * found.topRows(n_u) + parts_.E.transpose() * result.mu;
      x += driven_ * result.p;
    }
    result.q = parts_.modes->Q() * x;
    return result;
  }

private:
  const LinearisedSystem        &parts_;
  double                         omega_, unit_ = 1.;
  MatrixXcd                      D_, driven_, Y_;
  Eigen::PartialPivLU<MatrixXcd> lu_;
};

/// By the whole matrix [A_0 + W D W^T, -W E^T; E W^T, 0], scaled to unit diagonal.
class Whole final : public AtFrequency
{
public:
  Whole(const LinearisedSystem &parts, double omega) : parts_(parts), D_(parts.D(omega))
  {
    const Index    n = parts.n(), n_e = parts.E.rows();
    const MatrixXd W = parts.W;
    EW_              = parts.E * W.transpose();
    MatrixXcd A = (parts.C - omega * omega * parts.M).cast<Complex>() + Complex(0., omega) * parts.B.cast<Complex>() +
                  W * D_ * W.transpose();
    // Rows and columns alike, by what each coordinate has at most.
    scale_ = Eigen::VectorXd::Ones(n + n_e);
    for (Index i = 0; i < n; ++i)
      if (const double size = std::max(std::abs(A(i, i)), 1e-8 * A.row(i).cwiseAbs().maxCoeff()); size > 0.)
        scale_[i] = 1. / std::sqrt(size);
    MatrixXcd saddle                = MatrixXcd::Zero(n + n_e, n + n_e);
    saddle.topLeftCorner(n, n)      = A;
    saddle.topRightCorner(n, n_e)   = -EW_.transpose().cast<Complex>();
    saddle.bottomLeftCorner(n_e, n) = EW_.cast<Complex>();
    for (Index e = 0; e < n_e; ++e)
      if (const double size = (EW_.row(e) * scale_.head(n).asDiagonal()).norm(); size > 0.)
        scale_[n + e] = 1. / size;
    lu_.compute(scale_.asDiagonal() * saddle * scale_.asDiagonal());
  }

  Solution solve(const Solution &rhs) const override
  {
    const Index n = parts_.n(), n_e = parts_.E.rows();
    MatrixXcd   known(n + n_e, rhs.q.cols());
    known << rhs.q + parts_.W * rhs.p, rhs.mu;
    const MatrixXcd found = scale_.asDiagonal() * MatrixXcd(lu_.solve(scale_.asDiagonal() * known));
    Solution        result{found.topRows(n), {}, found.bottomRows(n_e)};
    result.p = rhs.p - D_ * (parts_.W.transpose() * result.q) + parts_.E.transpose() * result.mu;
    return result;
  }

private:
  const LinearisedSystem        &parts_;
  MatrixXcd                      D_;
  MatrixXd                       EW_;
  Eigen::VectorXd                scale_;
  Eigen::PartialPivLU<MatrixXcd> lu_;
};

/// A solution with refinements; nothing if these do not settle.
std::optional<Solution> refined(const LinearisedSystem &parts, const AtFrequency &equations, double omega,
                                const MatrixXd &F)
{
  const Index cols = F.cols();
  Solution    x =
      equations.solve({F.cast<Complex>(), MatrixXcd::Zero(parts.n_u(), cols), MatrixXcd::Zero(parts.E.rows(), cols)});
  double        change      = 0.;
  constexpr int refinements = 2; // in long double: the first corrects, the second tells by how much that was wrong
  for (int k = 0; k < refinements; ++k)
  {
    const Residual r     = residual(parts, omega, F, x);
    const Solution delta = equations.solve({r.q.cast<Complex>(), r.p.cast<Complex>(), r.mu.cast<Complex>()});
    x.q += delta.q;
    x.p += delta.p;
    x.mu += delta.mu;
    change = 0.;
    for (Index c = 0; c < cols; ++c)
      if (const double size = x.q.col(c).norm(); size > 0. || !std::isfinite(size))
        change = std::max(change, std::isfinite(size) ? delta.q.col(c).norm() / size : INFINITY);
  }
  constexpr double settled = 1e-9; // last correction, relative, that tells a solution from a failed one
  if (!(change < settled) || !x.q.allFinite() || !x.p.allFinite() || !x.mu.allFinite())
    return std::nullopt;
  return x;
}

/// Entries of the base that are not zero.
std::vector<LinearisedSystem::BaseEntry> entries(const MatrixXd &M, const MatrixXd &B, const MatrixXd &C)
{
  std::vector<LinearisedSystem::BaseEntry> result;
  for (Index i = 0; i < M.rows(); ++i)
    for (Index j = 0; j < M.cols(); ++j)
      if (M(i, j) != 0. || B(i, j) != 0. || C(i, j) != 0.)
        result.push_back({i, j, M(i, j), B(i, j), C(i, j)});
  return result;
}

/// weights . amplitudes, without weights zero
Complex product(const Eigen::VectorXd &weights, const MatrixXcd &amplitudes, Index column)
{
  Complex sum = 0.;
  for (Index i = 0; i < weights.size(); ++i)
    if (weights[i] != 0.)
      sum += weights[i] * amplitudes(i, column);
  return sum;
}

} // namespace

Complex LinearAnswer::of(const Vibration &vibration, Index column) const
{
  const Complex s(0., vibration.omega);
  return product(q, vibration.q, column) + s * product(v, vibration.q, column) +
         s * s * product(a, vibration.q, column) + product(p, vibration.p, column) +
         product(lambda, vibration.lambda, column);
}

LinearResponse::LinearResponse(const SecondOrderSystem &system, const OperatingPoint &point)
    : parts_(std::make_unique<LinearisedSystem>())
{
  LinearisedSystem &own = *parts_;
  if (!system.linear().dense_matrices(own.M, own.B, own.C))
    throw std::invalid_argument("frequency response: the base system is sparse and has " +
                                std::to_string(system.linear().size()) +
                                " DOFs; reduce the frame (reduction.method = \"craig-bampton\")");
  if (system.forces().need_multipliers())
    throw std::invalid_argument("frequency response: friction in ideal joints depends on their forces, whose "
                                "derivatives are not available; remove it, or make the joint compliant");
  own.base = entries(own.M, own.B, own.C);
  own.W    = system.forces().directions();
  linearise_elements(system, point.local, own);
  if (point.joint_stiffness.size() > 0)
    own.K_u += point.joint_stiffness;
  own.E   = bound_motions(system, point.local);
  own.n_c = system.joints().n_rows();
  try
  {
    const MatrixXd W = own.W;
    own.modes.emplace(system.linear(), W, W);
  }
  catch (const std::invalid_argument &error)
  {
    own.not_condensed = error.what();
  }
}

LinearResponse::~LinearResponse()                          = default;
LinearResponse::LinearResponse(LinearResponse &&) noexcept = default;

const std::string &LinearResponse::not_condensed() const
{
  return parts_->not_condensed;
}

std::optional<std::vector<Complex>> LinearResponse::growing() const
{
  const MatrixXd W    = parts_->W;
  const auto     with = [&](const MatrixXd &base, const MatrixXd &elements)
  { return MatrixXd(base + W * elements * W.transpose()); };
  return unstable_modes(with(parts_->M, parts_->M_u), with(parts_->B, parts_->B_u), with(parts_->C, parts_->K_u),
                        parts_->E * W.transpose());
}

Vibration LinearResponse::at(double omega, const MatrixXd &forces) const
{
  if (!(omega > 0.) || !std::isfinite(omega))
    throw std::invalid_argument("frequency response: the frequency is " + std::to_string(omega / 6.283185307179586) +
                                " Hz; it must be above zero");
  std::optional<Solution> x;
  if (parts_->modes)
    x = refined(*parts_, Condensed(*parts_, omega), omega, forces);
  if (!x)
    x = refined(*parts_, Whole(*parts_, omega), omega, forces);
  if (!x)
  {
    std::ostringstream message;
    message.precision(10);
    message << "frequency response: at " << omega / 6.283185307179586
            << " Hz the vibration is not finite: there is an undamped mode, or a motion has neither mass nor "
               "stiffness; give it damping, or choose other frequencies";
    throw ConvergenceFailure(message.str());
  }
  return {omega, std::move(x->q), std::move(x->p), x->mu.topRows(parts_->n_c)};
}

} // namespace gestell::coupling

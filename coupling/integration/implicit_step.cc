#include "coupling/integration/implicit_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

namespace
{
constexpr double rounding            = 8. * std::numeric_limits<double>::epsilon();
constexpr double unknown_contraction = 1e-2; ///< assumed of Newton where it has not been seen, and at best

/// Gaussian elimination with partial pivoting in place; a few unknowns, no allocation.  False: singular.
bool solve_small(Eigen::MatrixXd &a, Eigen::VectorXd &x)
{
  const int n = static_cast<int>(x.size());
  for (int k = 0; k < n; ++k)
  {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a(i, k)) > std::abs(a(pivot, k)))
        pivot = i;
    if (!(std::abs(a(pivot, k)) > 0.))
      return false;
    if (pivot != k)
    {
      for (int j = k; j < n; ++j)
        std::swap(a(k, j), a(pivot, j));
      std::swap(x[k], x[pivot]);
    }
    const double inverse = 1. / a(k, k);
    for (int i = k + 1; i < n; ++i)
    {
      const double factor = a(i, k) * inverse;
      if (factor == 0.)
        continue;
      for (int j = k + 1; j < n; ++j)
        a(i, j) -= factor * a(k, j);
      x[i] -= factor * x[k];
    }
  }
  for (int k = n - 1; k >= 0; --k)
  {
    for (int j = k + 1; j < n; ++j)
      x[k] -= a(k, j) * x[j];
    x[k] /= a(k, k);
  }
  return x.allFinite();
}
} // namespace

ImplicitStep::ImplicitStep(const SecondOrderSystem &system, const NewtonOptions &options)
    : system_(system), options_(options)
{
  const int n_u = static_cast<int>(system.directions().cols());
  u_free_.setZero(n_u);
  residual_.setZero(n_u);
  correction_.setZero(n_u);
  u_begin_.setZero(n_u);
  scale_.setZero(n_u);
  dp_.setZero(n_u, n_u);
  jacobian_.setZero(n_u, n_u);
  begin(u_begin_);
}

void ImplicitStep::begin(const Eigen::VectorXd &u)
{
  u_begin_ = u;
  scale_.setZero();
  contraction_ = unknown_contraction;
}

const ImplicitStep::Condensed &ImplicitStep::condensed(double h_beta, IntegrationWork &work)
{
  const auto found = cache_.find(h_beta);
  if (found != cache_.end())
    return found->second;

  Condensed made;
  made.h_beta = h_beta;
  made.solver = system_.factorise(1., h_beta, h_beta * h_beta);
  ++work.factorisations;
  const auto &W = system_.directions();
  made.Y.resize(W.rows(), W.cols());
  Eigen::VectorXd x(W.rows());
  for (int j = 0; j < W.cols(); ++j)
  {
    made.solver->solve(h_beta * h_beta * Eigen::VectorXd(W.col(j)), x);
    made.Y.col(j) = x;
    ++work.solves;
  }
  made.S = W.transpose() * made.Y;
  return cache_.emplace(h_beta, std::move(made)).first->second;
}

void ImplicitStep::rates(double h_beta, const Eigen::VectorXd &g, const Eigen::VectorXd &g_rate,
                         LocalState &local) const
{
  const double inverse = 1. / h_beta;
  local.v              = inverse * (local.u - g);
  local.a              = inverse * (local.v - g_rate);
}

bool ImplicitStep::iterate(const Condensed &condensed, const Eigen::VectorXd &g, const Eigen::VectorXd &g_rate,
                           LocalState &local, Eigen::VectorXd &p, IntegrationWork &work)
{
  const double inverse     = 1. / condensed.h_beta;
  double       size_before = 0.;
  for (int iteration = 0; iteration < options_.max_iterations; ++iteration)
  {
    rates(condensed.h_beta, g, g_rate, local);
    system_.local_tangent(local, 1., inverse, inverse * inverse, p, dp_);
    ++work.newton;

    jacobian_.noalias() = -condensed.S.lazyProduct(dp_);
    jacobian_.diagonal().array() += 1.;
    residual_ = u_free_ - local.u;
    residual_.noalias() += condensed.S.lazyProduct(p);
    correction_ = residual_;
    if (!solve_small(jacobian_, correction_))
      return false;

    double size = 0.;
    for (int i = 0; i < correction_.size(); ++i)
    {
      // Floors: the way of one step, so that a motion from rest has a scale at once, and what rounding in u leaves.
      scale_[i] = std::max({scale_[i], std::abs(local.u[i] - u_begin_[i]), condensed.h_beta * std::abs(local.v[i]),
                            rounding / options_.tolerance * std::abs(local.u[i])});
      if (correction_[i] != 0.)
        size = std::max(size, std::abs(correction_[i]) / std::max(scale_[i], std::abs(correction_[i])));
    }
    // A correction that grows again jumps between the branches of a law: shorten it.
    const double damping = iteration > 7 && size > 0.5 * size_before ? 0.5 : 1.;
    local.u.noalias() += damping * correction_;
    if (iteration > 0 && size_before > 0.)
      contraction_ = std::clamp(size / size_before, 1e-4, 1.);
    const double remaining = contraction_ < 1. ? size * contraction_ / (1. - contraction_) : size;
    if (damping == 1. && (size <= options_.tolerance || remaining <= options_.tolerance))
    {
      // The forces of the corrected measures, to second order in the correction; u = u_free + S p stays exact.
      p.noalias() += dp_.lazyProduct(correction_);
      rates(condensed.h_beta, g, g_rate, local);
      contraction_ = std::max(contraction_, unknown_contraction);
      return true;
    }
    size_before = size;
  }
  return false;
}

void ImplicitStep::solve(const Condensed &condensed, double t, const Eigen::VectorXd &f, const Eigen::VectorXd &g,
                         const Eigen::VectorXd &g_rate, Eigen::VectorXd &q, LocalState &local, Eigen::VectorXd &p,
                         IntegrationWork &work)
{
  const auto &W = system_.directions();
  condensed.solver->solve(f, q);
  ++work.solves;
  local.t = t;
  if (W.cols() == 0)
    return;
  u_free_.noalias() = W.transpose() * q;
  if (!iterate(condensed, g, g_rate, local, p, work))
  {
    contraction_ = unknown_contraction;
    fail(t);
  }
  q.noalias() += condensed.Y.lazyProduct(p);
}

void ImplicitStep::fail(double t) const
{
  int worst = 0;
  for (int i = 1; i < residual_.size(); ++i)
    if (std::abs(residual_[i]) * scale_[worst] > std::abs(residual_[worst]) * scale_[i])
      worst = i;
  std::string coordinate = "?";
  for (Eigen::SparseMatrix<double>::InnerIterator it(system_.directions(), worst); it; ++it)
    coordinate = system_.coordinate_name(static_cast<int>(it.row()));
  std::ostringstream message;
  message << "Newton's method did not converge at t = " << t << " s in " << options_.max_iterations
          << " iterations; the largest residual is " << std::abs(residual_[worst]) << " (m or rad) at the force on "
          << coordinate;
  throw ConvergenceFailure(message.str());
}

} // namespace gestell::coupling

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
} // namespace

namespace
{
bool is_held(const std::vector<HeldMeasure> &held, Eigen::Index measure)
{
  for (const HeldMeasure &h : held)
    if (h.measure == measure)
      return true;
  return false;
}
} // namespace

void fail_singular(const SecondOrderSystem &system, double t)
{
  std::ostringstream message;
  message << "the equation of the forces is singular at t = " << t << " s";
  const char *separator = ": the elements that stick hold the same motion, on ";
  for (const HeldMeasure &h : system.held())
    for (Eigen::SparseMatrix<double>::InnerIterator it(system.directions(), h.measure); it; ++it)
    {
      message << separator << system.coordinate_name(static_cast<int>(it.row()));
      separator = ", ";
    }
  if (!system.held().empty())
    message << "; make one of them a regularised friction, or put a spring between them";
  throw ConvergenceFailure(message.str());
}

ImplicitStep::ImplicitStep(const SecondOrderSystem &system, const NewtonOptions &options)
    : system_(system), options_(options)
{
  const int n_u = static_cast<int>(system.directions().cols());
  xi_.setZero(n_u);
  xi_free_.setZero(n_u);
  residual_.setZero(n_u);
  correction_.setZero(n_u);
  u_begin_.setZero(n_u);
  scale_.setZero(n_u);
  scale_before_.setZero(n_u);
  dp_.setZero(n_u, n_u);
  jacobian_.resize(n_u);
  begin(u_begin_);
}

void ImplicitStep::begin(const Eigen::VectorXd &u)
{
  u_begin_ = u;
  scale_.setZero();
  contraction_ = unknown_contraction;
}

const ImplicitStep::Condensed &ImplicitStep::condensed(const StepForm &form, IntegrationWork &work)
{
  const std::array<double, 4> key{form.w_M, form.w_B, form.w_C, form.force};
  const auto                  found = cache_.find(key);
  if (found != cache_.end())
    return found->second;

  Condensed made;
  made.form   = form;
  made.solver = system_.factorise(form.w_M, form.w_B, form.w_C);
  ++work.factorisations;
  const auto &W = system_.directions();
  made.Y.resize(W.rows(), W.cols());
  Eigen::VectorXd x(W.rows());
  for (int j = 0; j < W.cols(); ++j)
  {
    made.solver->solve(form.force * Eigen::VectorXd(W.col(j)), x);
    made.Y.col(j) = x;
    ++work.solves;
  }
  made.S = W.transpose() * made.Y;
  return cache_.emplace(key, std::move(made)).first->second;
}

void ImplicitStep::motion(const StepForm &form, const LocalState &base, LocalState &local) const
{
  local.u = base.u + form.w_u * xi_;
  local.v = base.v + form.w_v * xi_;
  local.a = base.a + form.w_a * xi_;
}

bool ImplicitStep::iterate(const Condensed &condensed, const LocalState &base, LocalState &local, IntegrationWork &work)
{
  const StepForm &form        = condensed.form;
  const auto     &held        = system_.held();
  double          size_before = 0.;
  for (const HeldMeasure &h : held)
    xi_[h.measure] = (h.rate - base.v[h.measure]) / form.w_v;
  for (int iteration = 0; iteration < options_.max_iterations; ++iteration)
  {
    motion(form, base, local);
    system_.local_tangent(local, form.w_u, form.w_v, form.w_a, local.p, dp_);
    ++work.newton;
    ++work.evaluations;
    for (const HeldMeasure &h : held) // the unknown of this column is p itself
    {
      dp_.row(h.measure).setZero();
      dp_.col(h.measure).setZero();
      dp_(h.measure, h.measure) = 1.;
    }

    Eigen::MatrixXd &jacobian = jacobian_.matrix();
    jacobian.noalias()        = -condensed.S.lazyProduct(dp_);
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i)
      if (!is_held(held, i)) // adding 1 and taking it away again would round a small S away
        jacobian(i, i) += 1.;
    residual_ = xi_free_ - xi_;
    residual_.noalias() += condensed.S.lazyProduct(local.p);
    correction_ = residual_;
    singular_ = !jacobian_.factorise(!held.empty());
    if (singular_)
      return false;
    jacobian_.solve_in_place(correction_);
    if (!correction_.allFinite())
      return false;

    for (const HeldMeasure &h : held) // linear in p: nothing to iterate
    {
      local.p[h.measure] += correction_[h.measure];
      correction_[h.measure] = 0.;
    }
    double size = 0.;
    for (int i = 0; i < correction_.size(); ++i)
    {
      // Floors: the way of one step, so that a motion from rest has a scale at once, and what rounding in u leaves.
      scale_[i] = std::max({scale_[i], std::abs(local.u[i] - u_begin_[i]), form.time * std::abs(local.v[i]),
                            rounding / options_.tolerance * std::abs(local.u[i])});
      if (correction_[i] != 0.)
        size = std::max(size, std::abs(correction_[i]) / std::max(scale_[i], std::abs(correction_[i])));
    }
    // A correction that grows again jumps between the branches of a law: shorten it.
    const double damping = iteration > 7 && size > 0.5 * size_before ? 0.5 : 1.;
    xi_.noalias() += damping * correction_;
    if (iteration > 0 && size_before > 0.)
      contraction_ = std::clamp(size / size_before, 1e-4, 1.);
    const double remaining = contraction_ < 1. ? size * contraction_ / (1. - contraction_) : size;
    if (damping == 1. && (size <= options_.tolerance || remaining <= options_.tolerance))
    {
      // The forces of the corrected measures, to second order in the correction; xi = xi_free + S p stays exact.
      local.p.noalias() += dp_.lazyProduct(correction_);
      motion(form, base, local);
      contraction_ = std::max(contraction_, unknown_contraction);
      return true;
    }
    size_before = size;
  }
  return false;
}

void ImplicitStep::solve(const Condensed &condensed, const Eigen::VectorXd &f, const LocalState &base,
                         Eigen::VectorXd &x, LocalState &local, IntegrationWork &work)
{
  const auto &W = system_.directions();
  condensed.solver->solve(f, x);
  ++work.solves;
  local.t = base.t;
  if (W.cols() == 0)
  {
    if (!x.allFinite()) // with elements Newton sees it
      throw ConvergenceFailure("the motion grew beyond all numbers at t = " + std::to_string(base.t) + " s");
    return;
  }
  xi_free_.noalias() = W.transpose() * x;
  if (condensed.form.w_u != 0.)
    xi_ = (local.u - base.u) / condensed.form.w_u;
  else
    xi_ = xi_free_;
  scale_before_ = scale_;
  if (!iterate(condensed, base, local, work))
  {
    scale_       = scale_before_; // runaway iterates are no excursions
    contraction_ = unknown_contraction;
    fail(base.t);
  }
  x.noalias() += condensed.Y.lazyProduct(local.p);
}

void ImplicitStep::fail(double t) const
{
  if (singular_)
    fail_singular(system_, t);
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

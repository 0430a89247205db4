#include "coupling/integration/consistent_start.h"

#include "coupling/integration/implicit_step.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr double converged      = 1e-12; ///< correction of u'', relative to the terms it is the sum of
constexpr int    max_iterations = 25;

/// A coordinate without mass, or how the solver puts it.
[[noreturn]] void refuse_singular(const SecondOrderSystem &system, const std::string &method, const std::string &why)
{
  std::ostringstream message;
  message << method << ": the mass matrix is singular, so that the acceleration to begin with is not defined";
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(system.size()), column = unit;
  int             massless = -1;
  for (int i = 0; i < system.size() && massless < 0; ++i)
  {
    unit[i] = 1.;
    system.mass_times(unit, column);
    unit[i] = 0.;
    if (column.isZero(0.))
      massless = i;
  }
  if (massless >= 0)
    message << ": " << system.coordinate_name(massless) << " has no mass";
  else
    message << " (" << why << ")";
  message << "; give it mass, or use bdf, which needs none";
  throw std::invalid_argument(message.str());
}

} // namespace

ConsistentStart::ConsistentStart(const SecondOrderSystem &system, const std::string &method) : system_(system)
{
  const auto &W = system.directions();
  const auto  n = system.size(), n_u = static_cast<int>(W.cols());
  for (Eigen::VectorXd *x : {&f_, &product_})
    x->setZero(n);
  a_free_.setZero(n_u);
  correction_.setZero(n_u);
  dp_.setZero(n_u, n_u);
  jacobian_.resize(n_u);
  Y_.setZero(n, n_u);
  try
  {
    mass_ = system.factorise(1., 0., 0.);
  }
  catch (const std::invalid_argument &singular)
  {
    refuse_singular(system, method, singular.what());
  }
  // Solvers without a check of their own answer a singular M by values that are no numbers.
  f_.setOnes();
  mass_->solve(f_, product_);
  if (!product_.allFinite())
    refuse_singular(system, method, "no solution exists");
  for (int j = 0; j < n_u; ++j)
  {
    f_ = W.col(j);
    mass_->solve(f_, product_);
    Y_.col(j) = product_;
  }
  D_ = W.transpose() * Y_;
}

void ConsistentStart::solve(const Eigen::VectorXd &q, const Eigen::VectorXd &v, Eigen::VectorXd &a, LocalState &local,
                            IntegrationWork &work)
{
  system_.excitation().at(local.t, f_);
  system_.damping_times(v, product_);
  f_ -= product_;
  system_.stiffness_times(q, product_);
  f_ -= product_;
  mass_->solve(f_, a);
  ++work.solves;
  if (D_.cols() == 0)
    return;
  a_free_.noalias() = system_.directions().transpose() * a;
  iterate(local, work);
  a.noalias() += Y_.lazyProduct(local.p);
}

void ConsistentStart::iterate(LocalState &local, IntegrationWork &work)
{
  const auto &held = system_.held();
  local.a          = a_free_;
  for (const HeldMeasure &h : held)
    local.a[h.measure] = 0.;
  for (int iteration = 0; iteration < max_iterations; ++iteration)
  {
    system_.local_tangent(local, 0., 0., 1., local.p, dp_);
    ++work.newton;
    ++work.evaluations;
    for (const HeldMeasure &h : held) // the unknown of this column is p itself
    {
      dp_.row(h.measure).setZero();
      dp_.col(h.measure).setZero();
      dp_(h.measure, h.measure) = 1.;
    }
    Eigen::MatrixXd &jacobian = jacobian_.matrix();
    jacobian.noalias()        = -D_.lazyProduct(dp_);
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i)
      if (std::none_of(held.begin(), held.end(), [i](const HeldMeasure &h) { return h.measure == i; }))
        jacobian(i, i) += 1.;
    correction_ = a_free_ - local.a;
    correction_.noalias() += D_.lazyProduct(local.p);
    if (!jacobian_.factorise())
      fail_singular(system_, local.t);
    jacobian_.solve_in_place(correction_);
    for (const HeldMeasure &h : held) // linear in p: nothing to iterate
    {
      local.p[h.measure] += correction_[h.measure];
      correction_[h.measure] = 0.;
    }
    local.a += correction_;
    bool small = true;
    for (int i = 0; i < correction_.size(); ++i)
    {
      double scale = std::abs(a_free_[i]);
      for (int j = 0; j < correction_.size(); ++j)
        scale += std::abs(D_(i, j) * local.p[j]);
      small = small && std::abs(correction_[i]) <= converged * scale;
    }
    if (small)
      return;
  }
  std::ostringstream message;
  message << "the acceleration that belongs to the state at t = " << local.t << " s was not found in " << max_iterations
          << " iterations; the last correction was " << correction_.cwiseAbs().maxCoeff() << " m/s^2 (or rad/s^2)";
  throw ConvergenceFailure(message.str());
}

} // namespace gestell::coupling

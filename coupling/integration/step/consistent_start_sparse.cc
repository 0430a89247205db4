#include "coupling/integration/step/consistent_start.h"

#include "coupling/integration/step/directions.h"

#include "coupling/integration/step/implicit_step.h"
#include "coupling/integration/step/law_values.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

// Starts of systems with many joints: see ConsistentStart and SaddleMatrix for the equations.

void ConsistentStart::factorise_sparse(double t)
{
  if (saddle_->factorise(tangent_, G_))
    return;
  const int row = saddle_->failed() - saddle_->n_motion();
  if (row >= 0 && row < G_.n_rows())
    fail_dependent(system_, row, t);
  fail_singular(system_, t);
}

/// The smallest motion that moves the joints by -g_, whatever sticks: x, and the measures xi with it.
void ConsistentStart::move_sparse(Eigen::VectorXd &x, Eigen::VectorXd &xi, double t)
{
  saddle_->hold({});
  saddle_->set_weights(1., 0., 0., 1.);
  tangent_.setZero();
  factorise_sparse(t);
  y_.setZero(saddle_->size());
  y_.tail(g_.size()) = -g_;
  saddle_->solve_in_place(y_);
  x += y_.head(x.size());
  take_measures(system_.forces().directions(), y_, correction_);
  xi += correction_;
}

/// The terms of the sum u'': |u''_free| and W^T M^-1 W |p|, the largest of all measures.
double ConsistentStart::largest_acceleration(const Eigen::VectorXd &p)
{
  const auto &W = system_.forces().directions();
  correction_   = p.cwiseAbs();
  f_.setZero();
  for (int j = 0; j < W.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator it(W, j); it; ++it)
      f_[it.row()] += std::abs(it.value()) * correction_[j];
  mass_->solve(f_, product_);
  correction_.noalias() = W.transpose() * product_;
  return std::max(a_free_.cwiseAbs().maxCoeff(), correction_.cwiseAbs().maxCoeff());
}

/// Starts with a = M^-1 (f_t - B q' - C q), with that right-hand side in f_.
void ConsistentStart::iterate_sparse(Eigen::VectorXd &a, LocalState &local, IntegrationWork &work)
{
  const auto &W    = system_.forces().directions();
  const auto &held = system_.forces().held();
  const auto  n = a.size(), n_c = Eigen::Index(G_.n_rows());
  load_ = f_;
  saddle_->hold(held);
  saddle_->set_weights(1., 0., 0., 1.);
  system_.joints().constraints(local, g_, G_);
  system_.joints().rates(local, rate_, bias_);
  y_.setZero(saddle_->size());
  a_free_.noalias() = W.transpose() * a;
  local.a           = a_free_;
  for (const HeldMeasure &h : held)
    local.a[h.measure] = 0.;
  for (int iteration = 0; iteration < most_iterations(); ++iteration)
  {
    system_.forces().tangent_blocks(local, 0., 0., 1., local.p, tangent_);
    if (!local.p.allFinite() || !tangent_.allFinite())
      require_law_values(system_, local);
    G_.set_forces(local.lambda, local.p);
    ++work.newton;
    ++work.evaluations;
    // If no force depends on u'' or multipliers, one step is sufficient.
    const bool linear = linear_ = tangent_.isZero(0.) && !system_.forces().need_multipliers();
    factorise_sparse(local.t);
    ++work.factorisations;
    y_.head(n) = load_;
    y_.head(n).noalias() += W * local.p;
    y_.head(n).noalias() -= saddle_->A() * a;
    correction_.noalias() = W.transpose() * a;
    g_                    = -bias_;
    G_.add_product(-1., correction_, g_);
    y_.segment(n, n_c) = g_;
    for (std::size_t h = 0; h < held.size(); ++h)
      y_[n + n_c + Eigen::Index(h)] = -correction_[held[h].measure];
    saddle_->solve_in_place(y_);
    ++work.solves;
    a += y_.head(n);
    g_ = y_.segment(n, n_c);
    local.lambda += g_;
    for (std::size_t h = 0; h < held.size(); ++h)
      local.p[held[h].measure] += y_[n + n_c + Eigen::Index(h)];
    correction_.noalias() = W.transpose() * y_.head(n);
    const double change   = correction_.cwiseAbs().maxCoeff();
    local.a.noalias()     = W.transpose() * a;
    for (const HeldMeasure &h : held)
      local.a[h.measure] = 0.;
    G_.set_forces(local.lambda, local.p);
    if (linear || change <= converged * largest_acceleration(local.p))
      return;
  }
  fail_unconverged(local.t);
}

void ConsistentStart::find_compliance()
{
  const auto &W = system_.forces().directions();
  compliance_.setZero(W.cols());
  for (int j = 0; j < W.cols(); ++j)
  {
    f_ = W.col(j);
    mass_->solve(f_, product_);
    compliance_[j] = W.col(j).dot(product_);
  }
}

/// The bias of the joints is in bias_, and no force depends on u''.
bool ConsistentStart::follow_sparse(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const ImplicitStep &step,
                                    LocalState &local, IntegrationWork &work)
{
  const ConstraintJacobian &G = step.jacobian();
  set_load(local.t, q, v);
  rate_ = local.lambda;
  if (step_is_near_ && step.saddle()->has_factor() && close_sparse(*step.saddle(), G, local, work))
    return true;
  step_is_near_ = false;
  local.lambda  = rate_;
  saddle_->hold({});
  saddle_->set_weights(1., 0., 0., 1.);
  ++work.factorisations;
  if (saddle_->factorise(tangent_, G) && close_sparse(*saddle_, G, local, work))
    return true;
  local.lambda = rate_;
  return false;
}

/// The terms of g'' in every equation: the bias, and G times those of the sum u''.
void ConsistentStart::find_terms(const ConstraintJacobian &G, const LocalState &local)
{
  correction_           = local.a.cwiseAbs().cwiseMax(compliance_.cwiseProduct(local.p.cwiseAbs()));
  terms_                = bias_.cwiseAbs();
  const double *entries = G.values().data();
  for (const ConstraintBlock &block : G.blocks())
    for (int k = 0; k < block.n_measures; ++k)
      for (int i = 0; i < block.n_rows; ++i)
        terms_[block.first_row + i] += std::abs(*entries++) * correction_[block.first_measure + k];
}

/// Corrects lambda by the factor of K until g'' is zero to `converged` in every equation.
bool ConsistentStart::close_sparse(const SaddleMatrix &K, const ConstraintJacobian &G, LocalState &local,
                                   IntegrationWork &work)
{
  const auto &W = system_.forces().directions();
  y_.resize(K.size());
  for (int correction = 0; correction <= most_corrections; ++correction)
  {
    G.set_forces(local.lambda, local.p);
    load_ = f_;
    add_forces(W, 1., local.p, load_);
    mass_->solve(load_, product_);
    take_measures(W, product_, local.a);
    g_ = bias_;
    G.add_product(1., local.a, g_);
    if (correction == 0)
      find_terms(G, local);
    if ((g_.array().abs() <= converged * terms_.array()).all())
      return true;
    y_.setZero();
    y_.segment(product_.size(), g_.size()) = -g_;
    K.solve_in_place(y_);
    ++work.solves;
    local.lambda += y_.segment(product_.size(), g_.size());
  }
  return false;
}

} // namespace gestell::coupling

#include "coupling/integration/step/consistent_start.h"

#include "coupling/integration/step/implicit_step.h"
#include "coupling/integration/step/law_values.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{

/// The largest g'' compared with its terms: the bias, and G times the accelerations whose sum u'' is.
double largest_opening(const Eigen::VectorXd &g, const Eigen::VectorXd &bias, const ConstraintJacobian &G,
                       const LocalState &local, const Eigen::VectorXd &compliance)
{
  double largest = 0.;
  for (std::size_t b = 0; b < G.blocks().size(); ++b)
  {
    const ConstraintBlock &block = G.blocks()[b];
    for (int i = 0; i < block.n_rows; ++i)
    {
      const int row   = block.first_row + i;
      double    terms = std::abs(bias[row]);
      for (int k = 0, j = block.first_measure; k < block.n_measures; ++k, ++j)
        terms += std::abs(G[b](i, k)) * std::max(std::abs(local.a[j]), compliance[j] * std::abs(local.p[j]));
      if (!(std::abs(g[row]) <= largest * terms))
        largest = std::abs(g[row]) / terms;
    }
  }
  return largest;
}

} // namespace

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
  xi.noalias() += system_.forces().directions().transpose() * y_.head(x.size());
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
    const bool linear = tangent_.isZero(0.) && !system_.forces().need_multipliers();
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

/// The bias of the joints is in bias_.
bool ConsistentStart::follow_sparse(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const ImplicitStep &step,
                                    LocalState &local, IntegrationWork &work)
{
  const auto               &W = system_.forces().directions();
  const SaddleMatrix       &K = *step.saddle();
  const ConstraintJacobian &G = step.jacobian();
  set_load(local.t, q, v);
  y_.resize(K.size());
  rate_ = local.lambda;
  local.lambda += shift_;
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  double           open     = std::numeric_limits<double>::infinity();
  for (int correction = 0; K.has_factor() && correction <= most_corrections; ++correction)
  {
    G.set_forces(local.lambda, local.p);
    load_ = f_;
    load_.noalias() += W * local.p;
    mass_->solve(load_, product_);
    local.a.noalias() = W.transpose() * product_;
    g_                = bias_;
    G.add_product(1., local.a, g_);
    const double before = open;
    open                = largest_opening(g_, bias_, G, local, compliance_);
    if (open <= rounding || (open <= converged && open >= 0.5 * before)) // nothing left but rounding
    {
      shift_ = local.lambda - rate_;
      return true;
    }
    y_.setZero();
    y_.segment(product_.size(), g_.size()) = -g_;
    K.solve_in_place(y_);
    ++work.solves;
    local.lambda += y_.segment(product_.size(), g_.size());
  }
  local.lambda  = rate_;
  step_is_near_ = false;
  return false;
}

} // namespace gestell::coupling

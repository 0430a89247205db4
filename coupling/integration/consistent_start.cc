#include "coupling/integration/consistent_start.h"

#include "coupling/integration/implicit_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr double closed = 1e-10; ///< what joints may be open by, in m or rad: rounding of large machines

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

[[noreturn]] void fail_open(const SecondOrderSystem &system, const Eigen::VectorXd &g, double t)
{
  int worst = 0;
  g.cwiseAbs().maxCoeff(&worst);
  std::ostringstream message;
  message << "the joints cannot be closed at t = " << t << " s: " << system.constraint_name(worst) << " stays open by "
          << g[worst] << " (m or rad); check positions and lengths";
  throw ConvergenceFailure(message.str());
}

} // namespace

ConsistentStart::ConsistentStart(const SecondOrderSystem &system, const std::string &method, JointSolver joints)
    : system_(system), G_(system.constraint_blocks())
{
  const auto n = system.size(), n_u = static_cast<int>(system.directions().cols());
  for (Eigen::VectorXd *x : {&f_, &product_})
    x->setZero(n);
  a_free_.setZero(n_u);
  correction_.setZero(n_u);
  scale_.setZero(n_u);
  for (Eigen::VectorXd *x : {&g_, &rate_, &bias_})
    x->setZero(G_.n_rows());
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
  saddle_ = SaddleMatrix::for_joints(system, joints);
  if (saddle_)
    size_for_sparse();
  else
    condense();
}

void ConsistentStart::condense()
{
  const auto &W   = system_.directions();
  const int   n_u = static_cast<int>(W.cols());
  dp_.setZero(n_u, n_u);
  jacobian_.resize(n_u);
  D_G_.setZero(n_u, G_.n_rows());
  schur_.resize(G_.n_rows());
  Y_.setZero(W.rows(), n_u);
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
  if (saddle_)
  {
    iterate_sparse(a, local, work);
    return;
  }
  if (D_.cols() == 0)
    return;
  a_free_.noalias() = system_.directions().transpose() * a;
  iterate(local, work);
  a.noalias() += Y_.lazyProduct(local.p);
}

/// Adds to the correction of u'' what keeps g'' = 0, and its multipliers.
void ConsistentStart::take_up_joints(LocalState &local)
{
  G_.times_transposed(D_, D_G_);
  for (Eigen::Index j = 0; j < D_G_.cols(); ++j)
    jacobian_.solve_in_place(D_G_.col(j));
  G_.times(D_G_, schur_.matrix());
  if (!schur_.factorise())
    fail_dependent(system_, schur_.failed(), local.t);
  g_ = -bias_;
  G_.add_product(-1., local.a, g_);
  G_.add_product(-1., correction_, g_);
  schur_.solve_in_place(g_);
  local.lambda += g_;
  correction_.noalias() += D_G_.lazyProduct(g_);
}

/// correction_ = G^T (G D G^T)^-1 g_, which moves the joints by g_.
void ConsistentStart::impulse_against(const LocalState &local)
{
  G_.times_transposed(D_, D_G_);
  G_.times(D_G_, schur_.matrix());
  if (!schur_.factorise())
    fail_dependent(system_, schur_.failed(), local.t);
  schur_.solve_in_place(g_);
  correction_.setZero();
  G_.set_forces(g_, correction_);
}

void ConsistentStart::project(Eigen::VectorXd &q, Eigen::VectorXd &v, LocalState &local)
{
  if (G_.n_rows() == 0)
    return;
  double open = std::numeric_limits<double>::infinity();
  for (int iteration = 0;; ++iteration)
  {
    system_.constraints(local, g_, G_);
    const double before = open;
    open                = g_.cwiseAbs().maxCoeff();
    if (open == 0. || (open <= closed && open >= 0.5 * before)) // nothing left but rounding
      break;
    if (!(open < std::numeric_limits<double>::infinity()) || iteration == max_iterations)
      fail_open(system_, g_, local.t);
    if (saddle_)
    {
      move_sparse(q, local.u, local.t);
      continue;
    }
    impulse_against(local);
    q.noalias() -= Y_.lazyProduct(correction_);
    local.u.noalias() -= D_.lazyProduct(correction_);
  }
  system_.constraint_rates(local, rate_, bias_);
  g_ = rate_;
  G_.add_product(1., local.v, g_);
  if (saddle_)
  {
    move_sparse(v, local.v, local.t);
    return;
  }
  impulse_against(local);
  v.noalias() -= Y_.lazyProduct(correction_);
  local.v.noalias() -= D_.lazyProduct(correction_);
}

void ConsistentStart::iterate(LocalState &local, IntegrationWork &work)
{
  const auto &held   = system_.held();
  const bool  joints = G_.n_rows() > 0;
  if (joints)
  {
    system_.constraints(local, g_, G_);
    system_.constraint_rates(local, rate_, bias_);
  }
  local.a = a_free_;
  for (const HeldMeasure &h : held)
    local.a[h.measure] = 0.;
  for (int iteration = 0; iteration < most_iterations(); ++iteration)
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
    if (joints)
      G_.set_forces(local.lambda, local.p);
    Eigen::MatrixXd &jacobian = jacobian_.matrix();
    bool             linear   = !system_.forces_need_multipliers(); // nor on u'': one step finds all
    for (Eigen::Index j = 0; j < jacobian.cols(); ++j)
    {
      auto column = jacobian.col(j);
      column.setZero();
      const bool is_held = std::any_of(held.begin(), held.end(), [j](const HeldMeasure &h) { return h.measure == j; });
      for (Eigen::Index i = 0; i < jacobian.rows(); ++i)
        if (dp_(i, j) != 0.)
          column.noalias() -= dp_(i, j) * D_.col(i);
      if (!is_held)
      {
        linear = linear && column.isZero(0.);
        column[j] += 1.;
      }
    }
    correction_ = a_free_ - local.a;
    correction_.noalias() += D_.lazyProduct(local.p);
    if (!jacobian_.factorise())
      fail_singular(system_, local.t);
    jacobian_.solve_in_place(correction_);
    if (joints)
      take_up_joints(local);
    for (const HeldMeasure &h : held) // linear in p: nothing to iterate
    {
      local.p[h.measure] += correction_[h.measure];
      correction_[h.measure] = 0.;
    }
    local.a += correction_;
    // Bodies in joints may be held by them: rounding of the others is what is left of their acceleration.
    double largest = 0.;
    for (int i = 0; i < correction_.size(); ++i)
    {
      scale_[i] = std::abs(a_free_[i]);
      for (int j = 0; j < correction_.size(); ++j)
        scale_[i] += std::abs(D_(i, j) * local.p[j]);
      largest = std::max(largest, scale_[i]);
    }
    if (joints)
      scale_.setConstant(largest);
    const bool small = (correction_.array().abs() <= converged * scale_.array()).all();
    if (small || linear)
    {
      if (joints)
        G_.set_forces(local.lambda, local.p);
      return;
    }
  }
  fail_unconverged(local.t);
}

int ConsistentStart::most_iterations() const
{
  return system_.forces_need_multipliers() ? most_by_friction : max_iterations;
}

void ConsistentStart::fail_unconverged(double t) const
{
  std::ostringstream message;
  message << "the acceleration that belongs to the state at t = " << t << " s was not found in " << most_iterations()
          << " iterations; the last correction was " << correction_.cwiseAbs().maxCoeff() << " m/s^2 (or rad/s^2)";
  if (system_.forces_need_multipliers())
    message << "; friction in a joint may make the force that causes it, so that the joint jams: lengthen the guide or "
               "lower the coefficient";
  throw ConvergenceFailure(message.str());
}

} // namespace gestell::coupling

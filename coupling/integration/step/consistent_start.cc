#include "coupling/integration/step/consistent_start.h"

#include "coupling/integration/step/condensed_matrix.h"
#include "coupling/integration/step/implicit_step.h"
#include "coupling/integration/step/law_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

namespace
{

/// Largest g of a joint against the size of the numbers whose difference it is.
double largest_gap(const Eigen::VectorXd &g, const std::vector<ConstraintBlock> &blocks)
{
  double largest = 0.;
  for (const ConstraintBlock &block : blocks)
    for (int i = block.first_row; i < block.first_row + block.n_rows; ++i)
      if (const double gap = std::abs(g[i]) / (block.size > 0. ? block.size : 1.); !(gap <= largest))
        largest = gap;
  return largest;
}

/// A coordinate without mass, or how the solver puts it.
[[noreturn]] void refuse_singular(const SecondOrderSystem &system, const std::string &method, const std::string &why)
{
  std::ostringstream message;
  message << method << ": the mass matrix is singular, so the initial acceleration is undefined";
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(system.linear().size()), column = unit;
  int             massless = -1;
  for (int i = 0; i < system.linear().size() && massless < 0; ++i)
  {
    unit[i] = 1.;
    system.linear().mass_times(unit, column);
    unit[i] = 0.;
    if (column.isZero(0.))
      massless = i;
  }
  if (massless >= 0)
    message << ": " << system.linear().coordinate_name(massless) << " has no mass";
  else
    message << " (" << why << ")";
  message << "; give it a mass, or use the method bdf";
  throw std::invalid_argument(message.str());
}

[[noreturn]] void fail_open(const SecondOrderSystem &system, const Eigen::VectorXd &g, double t)
{
  int worst = 0;
  g.cwiseAbs().maxCoeff(&worst);
  std::ostringstream message;
  message << "the joints cannot be assembled at t = " << t << " s: " << system.joints().name(worst) << " has a gap of "
          << g[worst] << " (m or rad); check positions and lengths";
  throw ConvergenceFailure(message.str());
}

} // namespace

void keep_held_rates(const SecondOrderSystem &system, Eigen::VectorXd &v)
{
  for (const HeldMeasure &h : system.forces().held())
    v[h.measure] = h.rate;
}

ConsistentStart::ConsistentStart(const SecondOrderSystem &system, const std::string &method, JointSolver joints)
    : system_(system), G_(system.joints().blocks())
{
  const auto n = system.linear().size(), n_u = static_cast<int>(system.forces().directions().cols());
  for (Eigen::VectorXd *x : {&f_, &product_, &a_})
    x->setZero(n);
  a_free_.setZero(n_u);
  correction_.setZero(n_u);
  scale_.setZero(n_u);
  for (Eigen::VectorXd *x : {&g_, &rate_, &bias_})
    x->setZero(G_.n_rows());
  try
  {
    mass_ = system.linear().factorise(1., 0., 0.);
  }
  catch (const std::invalid_argument &singular)
  {
    refuse_singular(system, method, singular.what());
  }
  // Solvers without their own check return values that are not finite for a singular M.
  f_.setOnes();
  mass_->solve(f_, product_);
  if (!product_.allFinite())
    refuse_singular(system, method, "no solution exists");
  tangent_.setZero(tangent_size(system.forces().blocks()));
  saddle_ = SaddleMatrix::for_joints(system, joints);
  if (saddle_)
    find_compliance();
  else
    condense();
}

ConsistentStart::~ConsistentStart() = default;

void ConsistentStart::condense()
{
  loaded_ = std::make_shared<const LoadedCoordinates>(system_.forces().directions());
  matrix_ = std::make_unique<CondensedMatrix>(system_, *loaded_);
  Y_.setZero(f_.size(), loaded_->size());
  for (int i = 0; i < loaded_->size(); ++i)
  {
    f_ = loaded_->unit_force(i);
    mass_->solve(f_, product_);
    Y_.col(i) = product_;
  }
  D_ = Compliance(loaded_, Y_);
}

void ConsistentStart::solve(const Eigen::VectorXd &q, const Eigen::VectorXd &v, Eigen::VectorXd &a, LocalState &local,
                            IntegrationWork &work)
{
  set_load(local.t, q, v);
  mass_->solve(f_, a);
  ++work.solves;
  if (saddle_)
  {
    iterate_sparse(a, local, work);
    return;
  }
  if (a_free_.size() == 0)
    return;
  a_free_.noalias() = system_.forces().directions().transpose() * a;
  iterate(local, work);
  a.noalias() += Y_.lazyProduct(D_.loads(local.p));
}

/// f = f_t - B q' - C q
void ConsistentStart::set_load(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v)
{
  system_.linear().excitation().at(t, f_);
  system_.linear().damping_times(v, product_);
  f_ -= product_;
  system_.linear().stiffness_times(q, product_);
  f_ -= product_;
}

void ConsistentStart::find_multipliers(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const ImplicitStep &step,
                                       LocalState &local, IntegrationWork &work)
{
  const auto known = [&]
  {
    if (!linear_ || !system_.forces().held().empty() || system_.forces().need_multipliers() || !local.p.allFinite())
      return false;
    system_.joints().rates(local, rate_, bias_);
    if (!saddle_)
      follow(q, v, step.jacobian(), local);
    return !saddle_ || follow_sparse(q, v, step, local, work);
  };
  if (!known())
    solve(q, v, a_, local, work);
}

/// u''_free = Y^T (f_t - B q' - C q) by tables, and lambda from (4) of docs/theory/joints.md; the bias
/// of the joints is in bias_.
void ConsistentStart::follow(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const ConstraintJacobian &G,
                             LocalState &local)
{
  const Excitation &excitation = system_.linear().excitation();
  if (Y_B_.size() == 0)
    tabulate();
  if (!load_known_ || !excitation.is_constant())
  {
    excitation.at(local.t, f_);
    a_load_.noalias() = Y_.transpose() * f_;
    load_known_       = true;
  }
  moved_ = a_load_;
  moved_.noalias() -= Y_B_ * v;
  moved_.noalias() -= Y_C_ * q;
  local.a.setZero();
  D_.add_moved(moved_, local.a);
  g_.setZero();
  G.set_forces(g_, local.p); // of the elements alone
  D_.add_times(local.p, local.a);
  matrix_->set_joints(D_, G);
  factorise(local.t);
  g_ = bias_;
  G.add_product(1., local.a, g_);
  correction_.setZero();
  matrix_->solve_in_place(D_, G, correction_, g_);
  local.a += correction_;
  local.lambda = g_;
  G.set_forces(local.lambda, local.p);
}

/// Y^T B and Y^T C by columns: few rows and many columns.
void ConsistentStart::tabulate()
{
  Y_B_.setZero(Y_.cols(), Y_.rows());
  Y_C_.setZero(Y_.cols(), Y_.rows());
  for (Eigen::Index j = 0; j < Y_.cols(); ++j)
  {
    f_ = Y_.col(j);
    system_.linear().damping_times(f_, product_);
    Y_B_.row(j) = product_;
    system_.linear().stiffness_times(f_, product_);
    Y_C_.row(j) = product_;
  }
}

void ConsistentStart::factorise(double t)
{
  if (matrix_->factorise(D_, tangent_, system_.forces().held()))
    return;
  if (matrix_->failed_joint() >= 0)
    fail_dependent(system_, matrix_->failed_joint(), t);
  fail_singular(system_, t);
}

/// Moves x, and its measures xi, by the impulses on the joints that change g by -g_, whatever sticks.
void ConsistentStart::move(Eigen::VectorXd &x, Eigen::VectorXd &xi, double t)
{
  tangent_.setZero();
  matrix_->set_joints(D_, G_);
  if (!matrix_->factorise(D_, tangent_, {}))
    fail_dependent(system_, matrix_->failed_joint(), t);
  correction_.setZero();
  matrix_->solve_in_place(D_, G_, correction_, g_);
  xi += correction_;
  correction_.setZero();
  G_.set_forces(g_, correction_);
  x.noalias() += Y_.lazyProduct(D_.loads(correction_));
}

void ConsistentStart::project(Eigen::VectorXd &q, Eigen::VectorXd &v, LocalState &local)
{
  if (G_.n_rows() == 0)
    return;
  step_is_near_             = true;
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  double           open     = std::numeric_limits<double>::infinity();
  for (int iteration = 0;; ++iteration)
  {
    system_.joints().constraints(local, g_, G_);
    const double before     = open;
    open                    = largest_gap(g_, G_.blocks());
    constexpr double closed = 1e-10; // share of its terms that a joint may be open by where rounding stops progress
    if (open <= rounding || (open <= closed && open >= 0.5 * before)) // nothing left but rounding
      break;
    if (!(open < std::numeric_limits<double>::infinity()) || iteration == max_iterations)
      fail_open(system_, g_, local.t);
    if (saddle_)
      move_sparse(q, local.u, local.t);
    else
      move(q, local.u, local.t);
  }
  system_.joints().rates(local, rate_, bias_);
  g_ = rate_;
  G_.add_product(1., local.v, g_);
  if (saddle_)
    move_sparse(v, local.v, local.t);
  else
    move(v, local.v, local.t);
}

/// Compares the correction of u'' with the terms of its sum.  If joints constrain bodies completely, only the rounding
/// of these terms is left of the acceleration.
bool ConsistentStart::is_small(const Eigen::VectorXd &p)
{
  scale_ = D_.magnitudes(p) + a_free_.cwiseAbs();
  if (G_.n_rows() > 0)
    scale_.setConstant(scale_.maxCoeff());
  return (correction_.array().abs() <= converged * scale_.array()).all();
}

void ConsistentStart::iterate(LocalState &local, IntegrationWork &work)
{
  const auto &held   = system_.forces().held();
  const bool  joints = G_.n_rows() > 0;
  if (joints)
  {
    system_.joints().constraints(local, g_, G_);
    system_.joints().rates(local, rate_, bias_);
    matrix_->set_joints(D_, G_);
  }
  local.a = a_free_;
  for (const HeldMeasure &h : held)
    local.a[h.measure] = 0.;
  for (int iteration = 0; iteration < most_iterations(); ++iteration)
  {
    system_.forces().tangent_blocks(local, 0., 0., 1., local.p, tangent_);
    if (!local.p.allFinite() || !tangent_.allFinite())
      require_law_values(system_, local);
    ++work.newton;
    ++work.evaluations;
    // If no force depends on u'' or multipliers, one step is sufficient.
    const bool linear = linear_ = tangent_.isZero(0.) && !system_.forces().need_multipliers();
    if (joints)
    {
      G_.set_forces(local.lambda, local.p);
      g_ = bias_;
      G_.add_product(1., local.a, g_);
    }
    correction_ = a_free_ - local.a;
    D_.add_times(local.p, correction_);
    factorise(local.t);
    matrix_->solve_in_place(D_, G_, correction_, g_);
    if (joints)
      local.lambda += g_;
    for (const HeldMeasure &h : held) // linear in p: nothing to iterate
    {
      local.p[h.measure] += correction_[h.measure];
      correction_[h.measure] = 0.;
    }
    local.a += correction_;
    if (linear || is_small(local.p))
    {
      if (joints)
        G_.set_forces(local.lambda, local.p);
      return;
    }
  }
  fail_unconverged(local.t);
}

void ConsistentStart::hold(const Eigen::VectorXd &q, const Eigen::VectorXd &v, LocalState &local, IntegrationWork &work)
{
  if (saddle_ || G_.n_rows() > 0 || !linear_)
  {
    solve(q, v, a_, local, work);
    return;
  }
  prepare_hold(local.t);
  system_.linear().excitation().at(local.t, f_);
  system_.forces().force(local, local.p);
  ++work.evaluations;
  for (const int h : holding_)
    local.p[h] = local.a[h] = 0.;
  held_p_.noalias() = hold_v_.transpose() * v;
  held_p_.noalias() += hold_q_.transpose() * q;
  held_p_.noalias() -= hold_f_.transpose() * f_;
  for (std::size_t i = 0; i < holding_.size(); ++i)
    held_p_[Eigen::Index(i)] -= hold_D_.row(Eigen::Index(i)).dot(local.p);
  delassus_.solve_in_place(held_p_);
  for (std::size_t i = 0; i < holding_.size(); ++i)
    local.p[holding_[i]] = held_p_[Eigen::Index(i)];
}

/// Prepares hold() for the measures that stick now.
void ConsistentStart::prepare_hold(double t)
{
  const auto &held = system_.forces().held();
  const auto  same = [](int own, const HeldMeasure &h) { return own == h.measure; };
  if (std::equal(holding_.begin(), holding_.end(), held.begin(), held.end(), same))
    return;
  const auto n_h = Eigen::Index(held.size());
  holding_.clear();
  for (Eigen::MatrixXd *x : {&hold_f_, &hold_v_, &hold_q_})
    x->resize(f_.size(), n_h);
  held_p_.resize(n_h);
  delassus_.resize(int(n_h));
  for (Eigen::Index i = 0; i < n_h; ++i)
  {
    holding_.push_back(held[i].measure);
    product_ = system_.forces().directions().col(holding_.back());
    mass_->solve(product_, f_);
    hold_f_.col(i) = f_;
    system_.linear().damping_times(f_, product_);
    hold_v_.col(i) = product_;
    system_.linear().stiffness_times(f_, product_);
    hold_q_.col(i) = product_;
  }
  hold_D_ = hold_f_.transpose() * system_.forces().directions();
  for (int i = 0; i < n_h; ++i)
    for (int j = 0; j < n_h; ++j)
      delassus_.matrix()(i, j) = hold_D_(i, holding_[j]);
  if (!delassus_.factorise())
    fail_singular(system_, t);
}

int ConsistentStart::most_iterations() const
{
  return system_.forces().need_multipliers() ? most_by_friction : max_iterations;
}

void ConsistentStart::fail_unconverged(double t) const
{
  std::ostringstream message;
  message << "the acceleration for the state at t = " << t << " s was not found in " << most_iterations()
          << " iterations; the last correction was " << correction_.cwiseAbs().maxCoeff() << " m/s^2 (or rad/s^2)";
  int worst = 0;
  if (g_.size() > 0)
  {
    g_.cwiseAbs().maxCoeff(&worst);
    message << ", and the force of " << system_.joints().name(worst) << " changes most";
  }
  if (system_.forces().need_multipliers())
    message << "; friction in a joint may increase the force that causes it, so that the joint jams: lengthen the "
               "guide or reduce the coefficient";
  throw ConvergenceFailure(message.str());
}

} // namespace gestell::coupling

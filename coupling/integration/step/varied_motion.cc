#include "coupling/integration/step/varied_motion.h"

#include "coupling/integration/system/acceleration_forces.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/integration/system/turning_forces.h"

#include <algorithm>
#include <utility>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
} // namespace

VariedMotion::VariedMotion(const SecondOrderSystem &system, const TimeIntegrator &integrator)
    : system_(system), integrator_(integrator), jacobian_(system.joints().blocks())
{
  constexpr Index largest_inverse = 200; // coordinates of systems whose A^-1 is kept: it fits a cache
  if (system.linear().size() > largest_inverse || !system.linear().dense_matrices(M_, B_, C_))
    for (MatrixXd *matrix : {&M_, &B_, &C_})
      matrix->resize(0, 0);
}

VariedMotion::~VariedMotion() = default;

const LinearSolver &VariedMotion::mass()
{
  if (!mass_)
    mass_ = system_.linear().factorise(1., 0., 0.);
  return *mass_;
}

/// The product with a matrix of the system, by its dense form if there is one.
MatrixXd VariedMotion::times(Product product, const MatrixXd &dense, const MatrixXd &X) const
{
  if (dense.size() > 0)
    return dense * X;
  MatrixXd result(X.rows(), X.cols());
  VectorXd x(X.rows()), y(X.rows());
  for (Index j = 0; j < X.cols(); ++j)
  {
    x = X.col(j);
    (system_.linear().*product)(x, y);
    result.col(j) = y;
  }
  return result;
}

MatrixXd VariedMotion::solution(const LinearSolver &A, const MatrixXd &F) const
{
  MatrixXd X(F.rows(), F.cols());
  VectorXd f(F.rows()), x(F.rows());
  for (Index j = 0; j < F.cols(); ++j)
  {
    f = F.col(j);
    A.solve(f, x);
    X.col(j) = x;
  }
  return X;
}

/// A^-1 (M H_q + b H_w)
void VariedMotion::respond(const Form &form, const History &history, MatrixXd &free) const
{
  const auto &[b, H] = history;
  if (form.inverse.size() == 0)
  {
    free = solution(*form.A, times(&LinearSystem::mass_times, M_, H.q) + b * H.w);
    return;
  }
  free.noalias() = form.of_mass * H.q;
  free.noalias() += b * (form.inverse * H.w);
}

const VariedMotion::Form &VariedMotion::form(double b)
{
  constexpr std::size_t most     = 4;     // a grid has one, its start another; of parts of steps none returns
  constexpr double      rounding = 1e-12; // of lengths that are differences of times
  const auto            found    = std::find_if(forms_.begin(), forms_.end(),
                                                [&](const Form &form) { return std::abs(form.b - b) <= rounding * b; });
  if (found != forms_.end())
    forms_.splice(forms_.begin(), forms_, found);
  else
  {
    const MatrixXd W = system_.forces().directions();
    Form           made{b, system_.linear().factorise(1., b, b * b), {}, {}, {}, {}};
    if (M_.size() > 0)
    {
      made.inverse = solution(*made.A, MatrixXd::Identity(W.rows(), W.rows()));
      made.of_mass = made.inverse * M_;
    }
    made.Y = b * b * solution(*made.A, W);
    made.S = W.transpose() * made.Y;
    forms_.push_front(std::move(made));
    if (forms_.size() > most)
      forms_.pop_back();
  }
  return forms_.front();
}

void VariedMotion::begin_at(Point &&point)
{
  now_    = std::move(point);
  now_.w  = times(&LinearSystem::mass_times, M_, now_.v) + times(&LinearSystem::damping_times, B_, now_.q);
  starts_ = true;
  state_ = state_before_ = integrator_.local();
  by_accelerations_      = depend_on_accelerations(system_, state_);
  linearise_here();
  const auto &W = system_.forces().directions();
  local_.u      = W.transpose() * now_.q;
  local_.v      = W.transpose() * now_.v;
  local_.a.setZero(W.cols(), now_.q.cols());
  local_.p = p_u_ * local_.u + p_v_ * local_.v;
}

void VariedMotion::begin_tangents(const MatrixXd &dq, const MatrixXd &dv)
{
  Point point{integrator_.time(), dq, dv, {}};
  project(point.q, point.v);
  begin_at(std::move(point));
}

/// G dq = 0, G dv + dG/dt dq = 0.
void VariedMotion::project(MatrixXd &dq, MatrixXd &dv)
{
  if (jacobian_.n_rows() == 0)
    return;
  const MatrixXd W  = system_.forces().directions();
  LocalState     at = integrator_.local();
  VectorXd       g(jacobian_.n_rows());
  system_.joints().constraints(at, g, jacobian_);
  MatrixXd G(g.size(), dq.rows());
  jacobian_.times(W.transpose(), G);
  const MatrixXd X = solution(mass(), G.transpose()), H = G * X;
  dq -= X * lu_solution(H, G * dq);
  // dG/dt dq = d(G v)/dq dq along each column
  const MatrixXd du = W.transpose() * dq;
  MatrixXd       open(g.size(), dq.cols());
  const VectorXd here = at.u, v = at.v;
  VectorXd       rate(g.size());
  for (Index j = 0; j < dq.cols(); ++j)
  {
    constexpr double small = 1e-6; // [m, rad] of a turn: central differences of smooth equations are exact to 1e-10
    const double     size = du.col(j).cwiseAbs().maxCoeff(), way = size > 0. ? small / size : small;
    rate.setZero();
    for (const double side : {1., -1.})
    {
      at.u = here + side * way * du.col(j);
      system_.joints().constraints(at, g, jacobian_);
      jacobian_.add_product(side / (2. * way), v, rate);
    }
    open.col(j) = rate;
  }
  dv -= X * lu_solution(H, G * dv + open);
}

/// Derivatives of forces and joints at the present instant.
void VariedMotion::linearise_here()
{
  const LocalForces &elements = system_.forces();
  const IdealJoints &joints   = system_.joints();
  const Index        n_u = elements.directions().cols(), n_c = jacobian_.n_rows();
  LocalState         at = integrator_.local();
  p_u_.setZero(n_u, n_u);
  p_v_.setZero(n_u, n_u);
  p_a_.setZero(n_u, n_u);
  VectorXd p = at.p;
  if (by_accelerations_)
    elements.tangent(at, 0., 0., 1., p, p_a_);
  linearise(elements, at, p, p_u_, p_v_);
  if (n_c == 0)
    return;
  if (const auto *turning = dynamic_cast<const TurningForces *>(&joints))
    turning->add_turning(at, p_u_);
  VectorXd g(n_c);
  joints.constraints(at, g, jacobian_);
  G_.resize(n_c, n_u);
  jacobian_.times(MatrixXd::Identity(n_u, n_u), G_);
}

VariedMotion::History VariedMotion::history(double h, bool starts) const
{
  if (starts)
    return {0.5 * h, now_};
  const double r = h / (now_.t - before_.t), whole = 1. + 2. * r, one = (1. + r) * (1. + r) / whole,
               two = -r * r / whole;
  return {h * (1. + r) / whole,
          {0., one * now_.q + two * before_.q, one * now_.v + two * before_.v, one * now_.w + two * before_.w}};
}

/// dp [n_u x k] where du = u_free + S dp, dv = (du - H_u)/b, da = (dv - H_v)/b, and G du = g.
MatrixXd VariedMotion::forces(const Form &form, const MatrixXd &u_free, const LocalTangents &H, const MatrixXd &g) const
{
  const double   inverse = 1. / form.b;
  const MatrixXd P       = p_u_ + inverse * (p_v_ + inverse * p_a_);
  MatrixXd       dp      = -inverse * ((p_v_ + inverse * p_a_) * H.u + p_a_ * H.v); // of the history alone
  const auto    &held    = system_.forces().held();

  std::vector<int> on; // measures whose forces change, or that change forces
  for (Index i = 0; i < P.rows(); ++i)
    if (!P.row(i).isZero(0.) || !P.col(i).isZero(0.) || (G_.size() > 0 && !G_.col(i).isZero(0.)) ||
        std::any_of(held.begin(), held.end(), [&](const HeldMeasure &h) { return h.measure == i; }))
      on.push_back(int(i));
  const Index n = Index(on.size()), n_c = G_.rows(), n_h = Index(held.size());
  if (n == 0)
    return dp;
  const MatrixXd S    = form.S(on, on);
  const double   size = S.cwiseAbs().maxCoeff(); // forces in the unit of motions
  MatrixXd       by_force(n, n_c + n_h);         // dp of the unknown forces
  if (n_c > 0)
    by_force.leftCols(n_c) = G_(Eigen::all, on).transpose();
  MatrixXd K     = MatrixXd::Zero(n + n_c + n_h, n + n_c + n_h);
  MatrixXd rhs   = MatrixXd::Zero(K.rows(), u_free.cols());
  rhs.topRows(n) = u_free(on, Eigen::all) + S * dp(on, Eigen::all);
  if (n_c > 0)
  {
    K.block(n, 0, n_c, n)  = G_(Eigen::all, on);
    rhs.middleRows(n, n_c) = g;
  }
  for (Index h = 0; h < n_h; ++h)
  {
    const int   measure   = held[std::size_t(h)].measure;
    const Index place     = std::lower_bound(on.begin(), on.end(), measure) - on.begin();
    by_force.col(n_c + h) = VectorXd::Unit(n, place);
    K(n + n_c + h, place) = 1.;
    rhs.row(n + n_c + h)  = H.u.row(measure);
  }
  by_force /= size;
  K.topLeftCorner(n, n)          = MatrixXd::Identity(n, n) - S * P(on, on);
  K.topRightCorner(n, n_c + n_h) = -S * by_force;
  const MatrixXd x               = lu_solution(K, rhs);
  dp(on, Eigen::all) += P(on, on) * x.topRows(n) + by_force * x.bottomRows(n_c + n_h);
  return dp;
}

void VariedMotion::carry_tangents()
{
  const double t = integrator_.time(), h = t - now_.t;
  if (!(h > 0.))
    return;
  state_before_ = std::exchange(state_, integrator_.local());
  linearise_here();
  const auto   &W    = system_.forces().directions();
  const History past = history(h, starts_);
  const auto &[b, H] = past;
  const Form   &step = form(b);
  LocalTangents H_local{W.transpose() * H.q, W.transpose() * H.v, {}, {}};
  MatrixXd      free;
  respond(step, past, free);
  // Joints close at the end of the step, not in its middle.
  const MatrixXd g =
      starts_ && G_.size() > 0 ? MatrixXd(0.5 * (G_ * H_local.u)) : MatrixXd::Zero(G_.rows(), H.q.cols());
  local_.p = forces(step, W.transpose() * free, H_local, g);
  Point next{t, free + step.Y * local_.p, {}, {}};
  next.v   = (next.q - H.q) / b;
  next.w   = H.w + b * (W * local_.p - times(&LinearSystem::stiffness_times, C_, next.q));
  local_.a = (W.transpose() * next.v - H_local.v) / b;
  if (starts_)
  {
    next.q = 2. * next.q - now_.q;
    next.v = 2. * next.v - now_.v;
    next.w = 2. * next.w - now_.w;
  }
  local_.u = W.transpose() * next.q;
  local_.v = W.transpose() * next.v;
  before_  = std::exchange(now_, std::move(next));
  starts_  = false;
}

void VariedMotion::jump_tangents(const VectorXd &before, const Eigen::RowVectorXd &dt)
{
  VectorXd       jump(now_.q.rows());
  const VectorXd force = system_.forces().directions() * (before - integrator_.local().p);
  mass().solve(force, jump);
  begin_at({now_.t, now_.q, now_.v + jump * dt, {}});
}

void VariedMotion::tangents(MatrixXd &dq, MatrixXd &dv) const
{
  dq = now_.q;
  dv = now_.v;
}

/// Accelerations and forces by what they changed in the last step.
LocalTangents VariedMotion::local_rates()
{
  const double h    = state_.t - state_before_.t;
  const auto   rate = [&](const VectorXd &now, const VectorXd &before) -> MatrixXd
  { return h > 0. ? MatrixXd((now - before) / h) : MatrixXd::Zero(now.size(), 1); };
  return {state_.v, state_.a, rate(state_.a, state_before_.a), rate(state_.p, state_before_.p)};
}

} // namespace gestell::coupling

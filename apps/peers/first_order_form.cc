#include "apps/peers/first_order_form.h"

#include "coupling/integration/system/acceleration_forces.h"

namespace gestell::peers
{
namespace
{

/// Columns A^-1 W and S = W^T A^-1 W.
void condense(const coupling::LinearSolver &solver, const Eigen::SparseMatrix<double> &W, Eigen::VectorXd &column,
              Eigen::VectorXd &solution, Eigen::MatrixXd &Y, Eigen::MatrixXd &S)
{
  for (Eigen::Index j = 0; j < W.cols(); ++j)
  {
    column.setZero();
    for (Eigen::SparseMatrix<double>::InnerIterator entry(W, j); entry; ++entry)
      column[entry.row()] = entry.value();
    solver.solve(column, solution);
    Y.col(j) = solution;
  }
  S.noalias() = W.transpose() * Y;
}

} // namespace

FirstOrderForm::FirstOrderForm(const coupling::SecondOrderSystem &system)
    : system_(system), n_(system.linear().size()), n_u_(int(system.forces().directions().cols())),
      mass_(system.linear().factorise(1., 0., 0.)), Y_M_(n_, n_u_), S_M_(n_u_, n_u_), Y_(n_, n_u_), S_(n_u_, n_u_),
      dp_du_(Matrix::Zero(n_u_, n_u_)), dp_dv_(Matrix::Zero(n_u_, n_u_)), tangent_(Matrix::Zero(n_u_, n_u_)), q_(n_),
      v_(n_), f_(n_), a_(n_), product_(n_), column_(n_), xi_(n_u_), z_(n_u_), held_rate_(n_u_)
{
  if (system.joints().n_rows() > 0)
    throw std::invalid_argument("peers: the system has " + std::to_string(system.joints().n_rows()) +
                                " constraints; other solvers support machines without joints only.");
  if (const auto &massless = system.linear().virtual_coordinates(); !massless.empty())
    throw std::invalid_argument("peers: " + system.linear().coordinate_name(massless.front()) +
                                " has no mass; other solvers need mass in every coordinate.");
  local_.resize(system);
  coupling::refuse_acceleration_forces(system, local_, "the first-order form for other solvers");
  small_.resize(n_u_);
  condense(*mass_, system_.forces().directions(), column_, a_, Y_M_, S_M_);
}

void FirstOrderForm::local_state(double t, const double *y, coupling::LocalState &local)
{
  if (system_.forces().held().empty())
  {
    const auto &W     = system_.forces().directions();
    local.t           = t;
    local.u.noalias() = W.transpose() * Eigen::Map<const Vector>(y, n_);
    local.v.noalias() = W.transpose() * Eigen::Map<const Vector>(y + n_, n_);
    system_.forces().force(local, local.p);
    return;
  }
  load(t, y);
  local = local_;
}

/// f_ = f_t + W p - B v - C q; local_ is the motion of the measures with their forces.
void FirstOrderForm::load(double t, const double *y)
{
  const auto &W      = system_.forces().directions();
  q_                 = Eigen::Map<const Vector>(y, n_);
  v_                 = Eigen::Map<const Vector>(y + n_, n_);
  local_.t           = t;
  local_.u.noalias() = W.transpose() * q_;
  local_.v.noalias() = W.transpose() * v_;
  system_.forces().force(local_, local_.p);
  for (const coupling::HeldMeasure &held : system_.forces().held())
    local_.p[held.measure] = 0.;

  system_.linear().excitation().at(t, f_);
  f_.noalias() += W * local_.p;
  system_.linear().damping_times(v_, product_);
  f_ -= product_;
  system_.linear().stiffness_times(q_, product_);
  f_ -= product_;
  if (!system_.forces().held().empty())
    add_held_forces();
}

void FirstOrderForm::add_held_forces()
{
  const auto        &held = system_.forces().held();
  const auto        &W    = system_.forces().directions();
  const Eigen::Index n_h  = Eigen::Index(held.size());
  Matrix             S(n_h, n_h);
  Vector             free(n_h);
  mass_->solve(f_, a_);
  for (Eigen::Index i = 0; i < n_h; ++i)
  {
    free[i] = W.col(held[i].measure).dot(a_);
    for (Eigen::Index j = 0; j < n_h; ++j)
      S(i, j) = S_M_(held[i].measure, held[j].measure);
  }
  const Vector force = S.partialPivLu().solve(-free);
  for (Eigen::Index i = 0; i < n_h; ++i)
  {
    local_.p[held[i].measure] = force[i];
    f_ += force[i] * W.col(held[i].measure);
  }
}

void FirstOrderForm::rate(double t, const double *y, double *y_rate)
{
  ++work_.evaluations;
  load(t, y);
  mass_->solve(f_, a_);
  Eigen::Map<Vector>(y_rate, n_)      = v_;
  Eigen::Map<Vector>(y_rate + n_, n_) = a_;
}

void FirstOrderForm::residual(double t, const double *y, const double *y_rate, double *r)
{
  ++work_.evaluations;
  load(t, y);
  Eigen::Map<Vector>(r, n_) = Eigen::Map<const Vector>(y_rate, n_) - v_;
  a_                        = Eigen::Map<const Vector>(y_rate + n_, n_);
  system_.linear().mass_times(a_, product_);
  Eigen::Map<Vector>(r + n_, n_) = product_ - f_;
}

void FirstOrderForm::linearise(double t, const double *y)
{
  const auto &W      = system_.forces().directions();
  local_.t           = t;
  local_.u.noalias() = W.transpose() * Eigen::Map<const Vector>(y, n_);
  local_.v.noalias() = W.transpose() * Eigen::Map<const Vector>(y + n_, n_);
  system_.forces().derivatives(local_, local_.p, dp_du_, dp_dv_);
  for (const coupling::HeldMeasure &held : system_.forces().held())
  {
    dp_du_.row(held.measure).setZero();
    dp_dv_.row(held.measure).setZero();
  }
}

/// Woodbury in the measures: with A_0 = M + gamma B + gamma^2 C, Y = A_0^-1 W, S = W^T Y and D the tangent,
///     x = x_0 + Y z,   (I - D S) z = D W^T x_0;   a held measure has  (S z)_h = given - (W^T x_0)_h  instead.
bool FirstOrderForm::prepare(double w_M, double w_B, double w_C, double tangent_v, double tangent_u)
{
  ++work_.factorisations;
  if (w_M != known_M_ || w_B != known_B_ || w_C != known_C_)
  {
    shifted_ = system_.linear().factorise(w_M, w_B, w_C);
    condense(*shifted_, system_.forces().directions(), column_, a_, Y_, S_);
    work_.solves += n_u_;
    known_M_ = w_M, known_B_ = w_B, known_C_ = w_C;
  }
  tangent_        = tangent_v * dp_dv_ + tangent_u * dp_du_;
  Matrix &small   = small_.matrix();
  small.noalias() = -tangent_ * S_;
  small.diagonal().array() += 1.;
  for (const coupling::HeldMeasure &held : system_.forces().held())
    small.row(held.measure) = S_.row(held.measure);
  return small_.factorise();
}

bool FirstOrderForm::factorise(double gamma)
{
  gamma_ = gamma;
  return prepare(1., gamma, gamma * gamma, gamma, gamma * gamma);
}

bool FirstOrderForm::factorise_displacements(double w_M, double w_B)
{
  return system_.forces().held().empty() && prepare(w_M, w_B, 1., w_B, 1.);
}

void FirstOrderForm::solve_displacements(double *b)
{
  f_ = Eigen::Map<const Vector>(b, n_);
  solve_velocity();
  Eigen::Map<Vector>(b, n_) = f_;
}

void FirstOrderForm::displacement_residual(double t, const double *y, const double *acceleration, double *r)
{
  ++work_.evaluations;
  load(t, y);
  a_ = Eigen::Map<const Vector>(acceleration, n_);
  system_.linear().mass_times(a_, product_);
  Eigen::Map<Vector>(r, n_) = product_ - f_;
}

/// f_ := A^-1 f_, with the constraint W_h^T f_ = held_rate_ for prescribed measures.
void FirstOrderForm::solve_velocity()
{
  ++work_.solves;
  shifted_->solve(f_, a_);
  if (n_u_ > 0)
  {
    xi_.noalias() = system_.forces().directions().transpose() * a_;
    z_.noalias()  = tangent_ * xi_;
    for (const coupling::HeldMeasure &held : system_.forces().held())
      z_[held.measure] = held_rate_[held.measure] - xi_[held.measure];
    small_.solve_in_place(z_);
    a_.noalias() += Y_ * z_;
  }
  f_ = a_;
}

/// dq - gamma dv = b1,   A dv = M b2 - gamma (C - W dp/du W^T) b1.
void FirstOrderForm::solve_rate_form(double *b)
{
  Eigen::Map<Vector> b1(b, n_), b2(b + n_, n_);
  const auto        &W = system_.forces().directions();
  q_                   = b1;
  v_                   = b2;
  system_.linear().mass_times(v_, f_);
  system_.linear().stiffness_times(q_, product_);
  f_ -= gamma_ * product_;
  xi_.noalias() = W.transpose() * q_;
  z_.noalias()  = gamma_ * dp_du_ * xi_;
  f_.noalias() += W * z_;
  held_rate_.noalias() = W.transpose() * v_;
  solve_velocity();
  b1 += gamma_ * f_;
  b2 = f_;
}

/// dq/gamma - dv = b1,   A dv = gamma (b2 - gamma (C - W dp/du W^T) b1),   dq = gamma (b1 + dv).
void FirstOrderForm::solve_residual_form(double *b)
{
  Eigen::Map<Vector> b1(b, n_), b2(b + n_, n_);
  const auto        &W = system_.forces().directions();
  q_                   = b1;
  f_                   = gamma_ * b2;
  if (!system_.forces().held().empty())
  {
    mass_->solve(f_, a_);
    held_rate_.noalias() = W.transpose() * a_;
  }
  system_.linear().stiffness_times(q_, product_);
  f_ -= gamma_ * gamma_ * product_;
  xi_.noalias() = W.transpose() * q_;
  z_.noalias()  = gamma_ * gamma_ * dp_du_ * xi_;
  f_.noalias() += W * z_;
  solve_velocity();
  b1 = gamma_ * (b1 + f_);
  b2 = f_;
}

void FirstOrderForm::know_dense()
{
  if (dense_known_)
    return;
  if (!system_.linear().dense_matrices(M_, B_, C_))
    throw std::invalid_argument("peers: the system is too large for dense matrices; use the condensed solver.");
  const auto lu = M_.partialPivLu();
  M_inv_B_      = lu.solve(B_);
  M_inv_C_      = lu.solve(C_);
  dense_known_  = true;
}

void FirstOrderForm::rate_jacobian(Eigen::Ref<Matrix> J)
{
  const auto &W = system_.forces().directions();
  J.topLeftCorner(n_, n_).setZero();
  J.topRightCorner(n_, n_).setIdentity();
  J.bottomLeftCorner(n_, n_)  = -M_inv_C_;
  J.bottomRightCorner(n_, n_) = -M_inv_B_;
  J.bottomLeftCorner(n_, n_) += Matrix(Y_M_ * dp_du_) * W.transpose();
  J.bottomRightCorner(n_, n_) += Matrix(Y_M_ * dp_dv_) * W.transpose();
  // Held measures: J - M^-1 W_h (W_h^T M^-1 W_h)^-1 W_h^T J.
  const auto        &held = system_.forces().held();
  const Eigen::Index n_h  = Eigen::Index(held.size());
  if (n_h == 0)
    return;
  Matrix S(n_h, n_h), free(n_h, 2 * n_), Y(n_, n_h);
  for (Eigen::Index i = 0; i < n_h; ++i)
  {
    Y.col(i)    = Y_M_.col(held[i].measure);
    free.row(i) = Vector(W.col(held[i].measure)).transpose() * J.bottomRows(n_);
    for (Eigen::Index j = 0; j < n_h; ++j)
      S(i, j) = S_M_(held[i].measure, held[j].measure);
  }
  J.bottomRows(n_) -= Y * S.partialPivLu().solve(free);
}

bool FirstOrderForm::residual_jacobian(double gamma, Eigen::Ref<Matrix> J)
{
  if (!system_.forces().held().empty())
    return false;
  const auto &W               = system_.forces().directions();
  J.topLeftCorner(n_, n_)     = Matrix::Identity(n_, n_) / gamma;
  J.topRightCorner(n_, n_)    = -Matrix::Identity(n_, n_);
  J.bottomLeftCorner(n_, n_)  = C_;
  J.bottomRightCorner(n_, n_) = M_ / gamma + B_;
  J.bottomLeftCorner(n_, n_) -= Matrix(W * dp_du_) * W.transpose();
  J.bottomRightCorner(n_, n_) -= Matrix(W * dp_dv_) * W.transpose();
  return true;
}

} // namespace gestell::peers

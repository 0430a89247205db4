#include "coupling/machine/accelerations.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace
{

[[noreturn]] void refuse_singular(const SecondOrderSystem &system)
{
  const auto     &lags = system.linear().virtual_coordinates();
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(system.linear().size()), column = unit;
  std::string     massless = "a combination of coordinates";
  for (int i = 0; i < system.linear().size(); ++i)
  {
    unit[i] = 1.;
    system.linear().mass_times(unit, column);
    unit[i] = 0.;
    if (column.isZero(0.) && std::find(lags.begin(), lags.end(), i) == lags.end())
    {
      massless = "\"" + system.linear().coordinate_name(i) + "\"";
      break;
    }
  }
  throw std::invalid_argument(
      "accelerations are undefined for this machine: " + massless +
      " has no mass; give it a mass, or remove accelerations and forces of supports and cuts from output.signals");
}

/// Null if M is singular.
std::unique_ptr<LinearSolver> factor_of_mass(const SecondOrderSystem &system)
{
  try
  {
    auto            factor = system.linear().factorise(1., 0., 0.);
    Eigen::VectorXd f = Eigen::VectorXd::Ones(system.linear().size()), a = f;
    factor->solve(f, a);
    if (a.allFinite()) // a solver without a check of its own
      return factor;
  }
  catch (const std::invalid_argument &)
  {
  }
  return nullptr;
}

/// Of M + h B + h^2 C, h far below all periods: M, but regular where coordinates without mass have stiffness or
/// damping.
std::unique_ptr<LinearSolver> factor_of_brief_step(const SecondOrderSystem &system)
{
  constexpr double h = 1e-9; // [s]
  try
  {
    return system.linear().factorise(1., h, h * h);
  }
  catch (const std::invalid_argument &)
  {
    refuse_singular(system);
  }
}

/// Rows of q'' that a signal reads.
template <typename Add>
void add_rows(const Signal &signal, int n, Add &&add)
{
  Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
  for (const auto &[i, weight] : signal.on_a)
    row[i] += weight;
  if (!row.isZero(0.))
    add(row);
  if (signal.measure >= 0 && signal.quantity == 2) // a function of the accelerations of these coordinates
    for (const auto &[i, weight] : signal.on_q)
    {
      row.setZero();
      row[i] = 1.;
      add(row);
    }
  if (signal.computed)
    for (const Signal &part : signal.computed->of)
      add_rows(part, n, add);
}

} // namespace

Accelerations::Accelerations(const SecondOrderSystem &system, const std::vector<Signal> &signals) : system_(system)
{
  const int n = system.linear().size();
  for (Eigen::VectorXd *x : {&f_, &product_, &a_})
    x->setZero(n);
  p_.setZero(system.forces().directions().cols());
  mass_              = factor_of_mass(system);
  const bool regular = mass_ != nullptr;
  if (!regular)
    mass_ = factor_of_brief_step(system);
  // Rows that are cheaper than a solution: two products with sparse matrices and its factor cost 40 n multiplications
  // or more, a row 2 n.  A singular M has no other way.
  const Eigen::Index most_rows = regular ? 20 : n;
  Q_.resize(n, 0);
  for (const Signal &signal : signals)
    add_rows(signal, n, [&](const Eigen::VectorXd &row) { add_row(row, most_rows); });
  if (by_rows_)
    solve_rows(regular);
}

/// Extends Q by what it does not contain of a row, by the method of Gram and Schmidt.
void Accelerations::add_row(Eigen::VectorXd row, Eigen::Index most_rows)
{
  if (!by_rows_)
    return;
  constexpr double contained = 1e-12; // share of a row that is rounding of its products with Q
  row.normalize();
  for (int twice = 0; twice < 2; ++twice)
  {
    row -= Q_ * (Q_.transpose() * row).eval();
    if (const double left = row.norm(); left > contained)
      row /= left;
    else
      return;
  }
  by_rows_ = Q_.cols() < most_rows;
  if (!by_rows_)
    return;
  Q_.conservativeResize(Eigen::NoChange, Q_.cols() + 1);
  Q_.rightCols<1>() = row;
}

/// M y = s, with the factor of M or of almost M; the rows of coordinates without mass then have no solution.
void Accelerations::solve_row(const Eigen::VectorXd &s, bool regular)
{
  f_ = s;
  for (const int i : system_.linear().virtual_coordinates())
    f_[i] = 0.;
  mass_->solve(f_, a_);
  constexpr double solved = 1e-9; // of the row: far below integrators, far above the rounding of M y
  // Each correction is smaller than the one before by the larger of (h omega)^2 and h b/m, until they are rounding.
  for (double before = std::numeric_limits<double>::infinity(); !regular;)
  {
    system_.linear().mass_times(a_, product_);
    const Eigen::VectorXd left = f_ - product_;
    if (const double rest = left.norm(); !(rest < 0.5 * before))
    {
      if (rest <= solved)
        break;
      refuse_singular(system_);
    }
    else
      before = rest;
    mass_->solve(left, product_);
    a_ += product_;
  }
  for (const int i : system_.linear().virtual_coordinates())
    a_[i] = 0.;
}

void Accelerations::solve_rows(bool regular)
{
  for (Eigen::MatrixXd *X : {&Z_, &BZ_, &CZ_})
    X->resize(Q_.rows(), Q_.cols());
  for (Eigen::Index k = 0; k < Q_.cols(); ++k)
  {
    solve_row(Q_.col(k), regular);
    Z_.col(k) = a_;
    system_.linear().damping_times(a_, product_);
    BZ_.col(k) = product_;
    system_.linear().stiffness_times(a_, product_);
    CZ_.col(k) = product_;
  }
  WZ_ = system_.forces().directions().transpose() * Z_;
  mass_.reset();
}

const Eigen::VectorXd &Accelerations::at(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const LocalState &local)
{
  p_ = local.p;
  system_.forces().force(local, p_);
  system_.linear().excitation().at(local.t, f_);
  if (by_rows_)
  {
    c_.noalias() = Z_.transpose() * f_;
    c_.noalias() += WZ_.transpose() * p_;
    c_.noalias() -= BZ_.transpose() * v;
    c_.noalias() -= CZ_.transpose() * q;
    a_.noalias() = Q_ * c_;
    return a_;
  }
  f_.noalias() += system_.forces().directions() * p_;
  system_.linear().damping_times(v, product_);
  f_ -= product_;
  system_.linear().stiffness_times(q, product_);
  f_ -= product_;
  for (const int i : system_.linear().virtual_coordinates())
    f_[i] = 0.;
  mass_->solve(f_, a_);
  return a_;
}

const Eigen::VectorXd &Accelerations::at(double t, const TimeIntegrator &integrator, const LocalState &local,
                                         Eigen::VectorXd &q, Eigen::VectorXd &v)
{
  if (t != integrator.time())
    integrator.interpolate(t, q, v);
  else
  {
    const Instant &now = integrator.instant();
    q                  = now.q;
    v                  = now.v;
  }
  return at(q, v, local);
}

std::optional<Accelerations> accelerations_for(const std::vector<Signal> &signals, const SecondOrderSystem &system)
{
  if (std::none_of(signals.begin(), signals.end(), [](const Signal &signal) { return signal.reads_acceleration(); }))
    return {};
  return Accelerations(system, signals);
}

} // namespace gestell::coupling

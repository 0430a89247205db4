#include "coupling/integration/energy_balance.h"

#include <algorithm>

namespace gestell::coupling
{

namespace
{
/// Gauss and Legendre, four points on (0, 1).
constexpr double gauss_points[]  = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
constexpr double gauss_weights[] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};
} // namespace

EnergyBalance::EnergyBalance(const SecondOrderSystem &system) : system_(system)
{
  for (Eigen::VectorXd *x : {&product_, &load_, &kinetic_, &kinetic_begin_, &between_.q, &between_.v})
    x->setZero(system.size());
  between_.local.resize(system);
}

EnergyBalance::Power EnergyBalance::sum(double weight_a, const Power &a, double weight_b, const Power &b)
{
  return {weight_a * a.input + weight_b * b.input, weight_a * a.dissipated + weight_b * b.dissipated};
}

/// x . product_, the virtual coordinates left out.
double EnergyBalance::work_with_product(const Eigen::VectorXd &x)
{
  for (const int i : system_.virtual_coordinates())
    product_[i] = 0.;
  return x.dot(product_);
}

EnergyBalance::Power EnergyBalance::power(const Instant &instant)
{
  Power power;
  system_.local_power(instant.local, instant.local.p, power.input, power.dissipated);
  system_.damping_times(instant.v, product_);
  power.dissipated += work_with_product(instant.v);
  if (!system_.excitation().is_constant())
  {
    system_.excitation().at(instant.t, load_);
    power.input += load_.dot(instant.v);
  }
  return power;
}

double EnergyBalance::stored(const Instant &instant, double in_elements)
{
  system_.mass_times(instant.v, product_);
  kinetic_      = 0.5 * instant.v.cwiseProduct(product_);
  double energy = kinetic_.sum();
  system_.stiffness_times(instant.q, product_);
  energy += 0.5 * work_with_product(instant.q);
  forces_ = product_.lpNorm<1>() + load_.lpNorm<1>() + instant.local.p.lpNorm<1>();
  if (system_.excitation().is_constant())
    energy -= load_.dot(instant.q);
  return energy + in_elements;
}

void EnergyBalance::begin(const Instant &instant)
{
  system_.excitation().at(instant.t, load_);
  t_begin_ = t_ = instant.t;
  work_begin_ = work_ = Power();
  first_ = last_ = power(instant);
  in_elements_   = system_.local_stored_energy(instant.local);
  stored_begin_  = stored(instant, in_elements_);
  kinetic_begin_ = kinetic_;
}

void EnergyBalance::jump(const Instant &instant)
{
  const double before = in_elements_;
  in_elements_        = system_.local_stored_energy(instant.local);
  work_.dissipated += std::max(0., before - in_elements_);
  last_ = power(instant);
}

void EnergyBalance::step(const Instant &instant)
{
  t_begin_     = t_;
  first_       = last_;
  work_begin_  = work_;
  last_        = power(instant);
  in_elements_ = system_.local_stored_energy(instant.local);
  t_           = instant.t;
  work_        = sum(1., work_, 0.5 * (t_ - t_begin_), sum(1., first_, 1., last_));
}

void EnergyBalance::step(const TimeIntegrator &integrator, PowerRule rule)
{
  step(integrator.instant());
  if (rule == PowerRule::trapezoidal)
    return;
  work_ = work_begin_;
  for (int i = 0; i < 4; ++i)
  {
    between_.t = t_begin_ + gauss_points[i] * (t_ - t_begin_);
    integrator.interpolate(between_.t, between_.q, between_.v);
    integrator.interpolate(between_.t, between_.local);
    system_.local_force(between_.local, between_.local.p);
    work_ = sum(1., work_, gauss_weights[i] * (t_ - t_begin_), power(between_));
  }
}

EnergyState EnergyBalance::state(const Instant &instant)
{
  Power work = work_;
  if (instant.t < t_)
  {
    const double h = t_ - t_begin_, s = (instant.t - t_begin_) / h, r = 1. - s;
    work = sum(1., sum(r * r * (1. + 2. * s), work_begin_, s * s * (1. + 2. * r), work_), 1.,
               sum(h * s * r * r, first_, -h * s * s * r, last_));
  }
  const double in_elements = instant.t < t_ ? system_.local_stored_energy(instant.local) : in_elements_;
  const double change      = stored(instant, in_elements) - stored_begin_;
  const auto   exchange    = (kinetic_ - kinetic_begin_).array();
  return {work.input, change, work.dissipated, std::max(exchange.max(0.).sum(), -exchange.min(0.).sum()), forces_};
}

} // namespace gestell::coupling

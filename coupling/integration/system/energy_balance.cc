#include "coupling/integration/system/energy_balance.h"
#include "coupling/integration/system/state_archive.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{
/// Gauss-Legendre quadrature, four points on (0, 1).
constexpr double gauss_points[]  = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
constexpr double gauss_weights[] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731, 0.1739274225687269};

} // namespace

EnergyBalance::EnergyBalance(const SecondOrderSystem &system) : system_(system)
{
  for (Eigen::VectorXd *x : {&product_, &load_, &kinetic_, &kinetic_begin_, &between_.q, &between_.v})
    x->setZero(system.linear().size());
  between_.local.resize(system);
}

EnergyBalance::Power EnergyBalance::sum(double weight_a, const Power &a, double weight_b, const Power &b)
{
  return {weight_a * a.input + weight_b * b.input, weight_a * a.dissipated + weight_b * b.dissipated};
}

/// x . product_, the virtual coordinates left out.
double EnergyBalance::work_with_product(const Eigen::VectorXd &x)
{
  for (const int i : system_.linear().virtual_coordinates())
    product_[i] = 0.;
  return x.dot(product_);
}

EnergyBalance::Power EnergyBalance::power(const Instant &instant)
{
  Power power;
  system_.energy().power(instant.local, instant.local.p, power.input, power.dissipated);
  system_.linear().damping_times(instant.v, product_);
  power.dissipated += work_with_product(instant.v);
  if (!system_.linear().excitation().is_constant())
  {
    system_.linear().excitation().at(instant.t, load_);
    power.input += load_.dot(instant.v);
  }
  return power;
}

double EnergyBalance::stored(const Instant &instant, double in_elements)
{
  system_.linear().mass_times(instant.v, product_);
  kinetic_      = 0.5 * instant.v.cwiseProduct(product_);
  double energy = kinetic_.sum();
  system_.linear().stiffness_times(instant.q, product_);
  energy += 0.5 * work_with_product(instant.q);
  forces_ = product_.lpNorm<1>() + load_.lpNorm<1>() + instant.local.p.lpNorm<1>();
  if (system_.linear().excitation().is_constant())
    energy -= load_.dot(instant.q);
  return energy + in_elements;
}

void EnergyBalance::begin(const Instant &instant)
{
  system_.linear().excitation().at(instant.t, load_);
  t_begin_ = t_ = instant.t;
  work_begin_ = work_ = Power();
  first_ = last_ = power(instant);
  in_elements_   = system_.energy().stored(instant.local);
  stored_ = stored_begin_ = stored(instant, in_elements_);
  kinetic_begin_          = kinetic_;
}

void EnergyBalance::jump(const Instant &instant)
{
  const double before = in_elements_;
  in_elements_        = system_.energy().stored(instant.local);
  work_.dissipated += std::max(0., before - in_elements_);
  stored_ += in_elements_ - before;
  last_ = power(instant);
}

void EnergyBalance::step(const Instant &instant)
{
  t_begin_     = t_;
  first_       = last_;
  work_begin_  = work_;
  last_        = power(instant);
  in_elements_ = system_.energy().stored(instant.local);
  t_           = instant.t;
  work_        = sum(1., work_, 0.5 * (t_ - t_begin_), sum(1., first_, 1., last_));
}

void EnergyBalance::step(const TimeIntegrator &integrator, const PowerRule &rule, double exchanged)
{
  stored_last_ = stored_;
  step(integrator.instant());
  panels_.clear();
  if (!rule.gauss)
    return;
  integrate(integrator, 1);
  if (!(t_ - t_begin_ > rule.shortest))
    return;
  stored_ = stored(integrator.instant(), in_elements_);
  // share of the energy exchanged, for one step: 1e5 of them add up to 1 % at worst
  constexpr double closed      = 1e-7;
  const double     small       = closed * std::max(exchanged, std::abs(stored_ - stored_begin_));
  constexpr int    most_panels = 4096; // 2^12: a load that still changes the work is not an integrable function
  for (int panels = 2; (t_ - t_begin_) * 2. > panels * rule.shortest && panels <= most_panels; panels *= 2)
  {
    if (open() <= small)
      return;
    const Power before = work_;
    integrate(integrator, panels);
    const double     change    = std::abs(work_.input - before.input) + std::abs(work_.dissipated - before.dissipated);
    constexpr double converged = 0.1; // share of the error: change by twice as many panels
    if (change < converged * open())
      return; // the remaining error is that of the method
  }
}

/// |input - dissipated - change of stored| over the last step.
double EnergyBalance::open() const
{
  return std::abs(work_.input - work_begin_.input - (work_.dissipated - work_begin_.dissipated) -
                  (stored_ - stored_last_));
}

void EnergyBalance::integrate(const TimeIntegrator &integrator, int panels)
{
  const double h = (t_ - t_begin_) / panels;
  panels_.assign(1, work_begin_);
  for (int i = 0; i < panels; ++i)
    panels_.push_back(sum(1., panels_.back(), 1., integral(integrator, t_begin_ + i * h, t_begin_ + (i + 1) * h)));
  work_ = panels_.back();
}

EnergyBalance::Power EnergyBalance::integral(const TimeIntegrator &integrator, double from, double to)
{
  Power work;
  for (int i = 0; i < 4; ++i)
  {
    between_.t = from + gauss_points[i] * (to - from);
    integrator.interpolate(between_.t, between_.q, between_.v);
    integrator.interpolate(between_.t, between_.local);
    system_.forces().force(between_.local, between_.local.p);
    work = sum(1., work, gauss_weights[i] * (to - from), power(between_));
  }
  return work;
}

/// Cubic through both ends and their powers.  Where the integral grows and both powers are positive it grows all the
/// way if no slope exceeds three times the mean one.
EnergyBalance::Power EnergyBalance::between(double t) const
{
  const double h = t_ - t_begin_, s = (t - t_begin_) / h, r = 1. - s,
               mean = (work_.dissipated - work_begin_.dissipated) / h;
  Power first = first_, last = last_;
  if (mean >= 0. && first.dissipated >= 0. && last.dissipated >= 0.)
  {
    first.dissipated = std::min(first.dissipated, 3. * mean);
    last.dissipated  = std::min(last.dissipated, 3. * mean);
  }
  return sum(1., sum(r * r * (1. + 2. * s), work_begin_, s * s * (1. + 2. * r), work_), 1.,
             sum(h * s * r * r, first, -h * s * s * r, last));
}

EnergyState EnergyBalance::at(const Instant &instant, const Power &work)
{
  const double in_elements = instant.t < t_ ? system_.energy().stored(instant.local) : in_elements_;
  const double now         = stored(instant, in_elements);
  const auto   exchange    = (kinetic_ - kinetic_begin_).array();
  if (!(instant.t < t_))
    stored_ = now;
  return {work.input, now - stored_begin_, work.dissipated, std::max(exchange.max(0.).sum(), -exchange.min(0.).sum()),
          forces_};
}

EnergyState EnergyBalance::state(const Instant &instant)
{
  return at(instant, instant.t < t_ ? between(instant.t) : work_);
}

EnergyState EnergyBalance::state(const TimeIntegrator &integrator, const Instant &instant)
{
  const auto panels = int(panels_.size()) - 1;
  if (panels < 1 || !(instant.t < t_))
    return state(instant);
  const double h    = (t_ - t_begin_) / panels;
  const int    i    = std::clamp(int((instant.t - t_begin_) / h), 0, panels - 1);
  const Power  work = sum(1., panels_[i], 1., integral(integrator, t_begin_ + i * h, instant.t));
  return at(instant, work);
}

void EnergyBalance::exchange(StateArchive &archive)
{
  archive(product_, load_, first_, last_, work_begin_, work_, panels_, t_begin_, t_, stored_last_, stored_,
          stored_begin_, in_elements_, forces_, kinetic_, kinetic_begin_);
}

} // namespace gestell::coupling

#include "coupling/integration/energy_balance.h"

namespace gestell::coupling
{

EnergyBalance::EnergyBalance(const SecondOrderSystem &system) : system_(system)
{
  product_.setZero(system.size());
  load_.setZero(system.size());
}

EnergyBalance::Power EnergyBalance::power(const Instant &instant)
{
  Power power{};
  system_.local_power(instant.local, instant.local.p, power.input, power.elements);
  system_.damping_times(instant.v, product_);
  power.damping = instant.v.dot(product_);
  if (!system_.excitation().is_constant())
  {
    system_.excitation().at(instant.t, load_);
    power.input += load_.dot(instant.v);
  }
  return power;
}

double EnergyBalance::stored(const Instant &instant)
{
  system_.mass_times(instant.v, product_);
  double energy = 0.5 * instant.v.dot(product_);
  system_.stiffness_times(instant.q, product_);
  energy += 0.5 * instant.q.dot(product_);
  if (system_.excitation().is_constant())
    energy -= load_.dot(instant.q);
  return energy + system_.local_stored_energy(instant.local);
}

void EnergyBalance::begin(const Instant &instant)
{
  system_.excitation().at(instant.t, load_);
  t_     = instant.t;
  input_ = elements_ = damping_ = 0.;
  last_                         = power(instant);
  elements_begin_               = system_.local_stored_energy(instant.local);
  stored_begin_                 = stored(instant);
}

void EnergyBalance::step(const Instant &instant)
{
  const Power  now  = power(instant);
  const double half = 0.5 * (instant.t - t_);
  input_ += half * (last_.input + now.input);
  elements_ += half * (last_.elements + now.elements);
  damping_ += half * (last_.damping + now.damping);
  last_ = now;
  t_    = instant.t;
}

EnergyState EnergyBalance::state(const Instant &instant)
{
  const double in_elements = system_.local_stored_energy(instant.local) - elements_begin_;
  return {input_, stored(instant) - stored_begin_, damping_ - elements_ - in_elements};
}

} // namespace gestell::coupling

#pragma once

#include "coupling/integration/second_order_system.h"
#include "coupling/integration/time_integrator.h"

namespace gestell::coupling
{

/// Energy [J] since the start; residual() is input - stored - dissipated and would be zero for exact integration.
struct EnergyState
{
  double input = 0., stored = 0., dissipated = 0.;
  double residual() const { return input - stored - dissipated; }
};

/**
 * Energy balance of a run.
 *
 *     input       integral of the drives' power (and of a load that varies in time)
 *     stored      change of q'^T M q'/2 + q^T C q/2 - f_t^T q (constant load) + energy in the elements
 *     dissipated  integral of q'^T B q' and of what the elements take up beyond their stored energy
 *
 * Integrals by the trapezoidal rule over the steps: second order in h, as the integrators it judges.
 */
class EnergyBalance
{
public:
  explicit EnergyBalance(const SecondOrderSystem &system);

  void        begin(const Instant &instant);
  void        step(const Instant &instant);  ///< once per accepted step
  EnergyState state(const Instant &instant); ///< at the instant last given to step()

private:
  struct Power
  {
    double input, elements, damping;
  };
  Power  power(const Instant &instant);
  double stored(const Instant &instant);

  const SecondOrderSystem &system_;
  Eigen::VectorXd          product_, load_;
  Power                    last_{};
  double                   t_ = 0., input_ = 0., elements_ = 0., damping_ = 0.;
  double                   stored_begin_ = 0., elements_begin_ = 0.;
};

} // namespace gestell::coupling

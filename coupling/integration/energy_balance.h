#pragma once

#include "coupling/integration/second_order_system.h"
#include "coupling/integration/time_integrator.h"

namespace gestell::coupling
{

/// Energy [J] since the start; residual() is input - stored - dissipated and would be zero for exact integration.
struct EnergyState
{
  double input = 0., stored = 0., dissipated = 0.;
  /// Kinetic energy that some coordinates gained or others lost, whichever is more: a free top turns over what it
  /// keeps.
  double kinetic = 0.;
  double forces  = 0.; ///< sum of the magnitudes of loads, of C q and of the elements' forces: what rounding works with
  double residual() const { return input - stored - dissipated; }
};

/// How powers are integrated over a step.
enum class PowerRule
{
  trapezoidal, ///< second order, as good as integrators of that order with steps short against the motion
  gauss        ///< four points on the dense output, order 8: steps long against the motion
};

/**
 * Energy balance of a run.
 *
 *     input       integral of the drives' power (and of a load that varies in time)
 *     stored      change of q'^T M q'/2 + q^T C q/2 - f_t^T q (constant load) + energy in the elements
 *     dissipated  integral of q'^T B q' and of what the laws of the elements take beyond what they store
 *
 * Every law is asked for the power it takes in the motion at hand, never by what is missing from the store: the error
 * of the method stands in the residual alone, and laws that only take make `dissipated` grow, as all weights are
 * positive.  Virtual coordinates have no part in it.
 *
 * Source: docs/theory/integration.md (11a).
 */
class EnergyBalance
{
public:
  explicit EnergyBalance(const SecondOrderSystem &system);

  void begin(const Instant &instant);
  /// Once per accepted step.
  void step(const Instant &instant); ///< trapezoidal
  void step(const TimeIntegrator &integrator, PowerRule rule);
  /// Forces have changed their branch at the instant of the last step: what elements have less in store is dissipated.
  void   jump(const Instant &instant);
  double at_begin() const { return stored_begin_; } ///< [J], what stored counts from
  /// At an instant inside the last step (integrals by the cubic through both ends and their powers) or at its end.
  EnergyState state(const Instant &instant);

private:
  /// Powers [W], or their integrals [J].
  struct Power
  {
    double input = 0., dissipated = 0.;
  };
  static Power sum(double weight_a, const Power &a, double weight_b, const Power &b);

  Power  power(const Instant &instant);
  double work_with_product(const Eigen::VectorXd &x);
  double stored(const Instant &instant, double in_elements);

  const SecondOrderSystem &system_;
  Eigen::VectorXd          product_, load_;
  Instant                  between_;
  Power                    first_, last_;      // at both ends of the last step
  Power                    work_begin_, work_; // integrals, likewise
  double                   t_begin_ = 0., t_ = 0.;
  double                   stored_begin_ = 0., in_elements_ = 0., forces_ = 0.; // in_elements_ at the end of the step
  Eigen::VectorXd          kinetic_, kinetic_begin_; // of every coordinate, at the instant of the last call of stored()
};

} // namespace gestell::coupling

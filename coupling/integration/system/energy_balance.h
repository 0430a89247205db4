#pragma once

#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/time_integrator.h"

#include <vector>

namespace gestell::coupling
{

class StateArchive;

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
struct PowerRule
{
  /// Four Gauss points on the dense output, order 8, for steps that may be long against the motion; else the
  /// trapezoidal rule, as good as integrators of second order with short steps.
  bool gauss = false;
  /// [s] of a panel of four points that is short against all that moves: where the balance stays open a step is divided
  /// into as many.
  double shortest = 1e300;
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
  /// @param exchanged  [J] so far, against which the balance of a step is open
  void step(const TimeIntegrator &integrator, const PowerRule &rule, double exchanged);
  /// Forces have changed their branch at the instant of the last step: what elements have less in store is dissipated.
  void   jump(const Instant &instant);
  double at_begin() const { return stored_begin_; } ///< [J], what stored counts from
  /// At the end of the last step, or at an instant inside it: integrals by the cubic through both ends and their
  /// powers, which does not fall where both ends say that the integral grows.
  EnergyState state(const Instant &instant);
  /// Likewise after a step by Gauss' rule: from the panel's begin to the instant by the same rule.
  EnergyState state(const TimeIntegrator &integrator, const Instant &instant);

  void exchange(StateArchive &archive);

private:
  /// Powers [W], or their integrals [J].
  struct Power
  {
    double input = 0., dissipated = 0.;
  };
  static Power sum(double weight_a, const Power &a, double weight_b, const Power &b);

  Power       power(const Instant &instant);
  Power       integral(const TimeIntegrator &integrator, double from, double to);
  void        integrate(const TimeIntegrator &integrator, int panels);
  double      open() const;
  Power       between(double t) const;
  EnergyState at(const Instant &instant, const Power &work);
  double      work_with_product(const Eigen::VectorXd &x);
  double      stored(const Instant &instant, double in_elements);

  const SecondOrderSystem &system_;
  Eigen::VectorXd          product_, load_;
  Instant                  between_;
  Power                    first_, last_;      // at both ends of the last step
  Power                    work_begin_, work_; // integrals, likewise
  std::vector<Power>       panels_;            // integrals at the ends of equal parts of the last step
  double                   t_begin_ = 0., t_ = 0.;
  double                   stored_last_ = 0., stored_ = 0.; // at both ends of the last step, if it is by Gauss' rule
  double                   stored_begin_ = 0., in_elements_ = 0., forces_ = 0.; // in_elements_ at the end of the step
  Eigen::VectorXd          kinetic_, kinetic_begin_; // of every coordinate, at the instant of the last call of stored()
};

} // namespace gestell::coupling

#pragma once

#include "coupling/integration/system/second_order_system.h"
#include "coupling/integration/system/time_integrator.h"

#include <vector>

namespace gestell::coupling
{

class StateArchive;

/// Energy [J] since the start; residual() is input - stored - dissipated and is zero for exact integration.
struct EnergyState
{
  double input = 0., stored = 0., dissipated = 0.;
  /// Kinetic energy that some coordinates gained or others lost, whichever is larger: in a free top, energy circulates
  /// between coordinates.
  double kinetic = 0.;
  double forces  = 0.; ///< sum of the magnitudes of loads, C q and the elements' forces, to estimate rounding errors
  double residual() const { return input - stored - dissipated; }
};

/// Quadrature of powers over a step.
struct PowerRule
{
  /// Four Gauss points on the dense output, order 8, for steps that may be long compared with the motion; else the
  /// trapezoidal rule, which suffices for integrators of second order with short steps.
  bool gauss = false;
  /// [s] length of a panel of four points that is short compared with all motions: if the balance is open, a step is
  /// divided into panels of this length.
  double shortest = 1e300;
};

/**
 * Energy balance of a run.
 *
 *     input       integral of the drives' power (and of a load that varies in time)
 *     stored      change of q'^T M q'/2 + q^T C q/2 - f_t^T q (constant load) + energy in the elements
 *     dissipated  integral of q'^T B q' and of what the laws of the elements take beyond what they store
 *
 * The power that a law takes is computed from the motion, never from changes of the stored energy: the error of the
 * method is therefore only in the residual, and laws that only dissipate make `dissipated` grow, because all weights
 * are positive.  Lag coordinates are not included.
 *
 * Source: docs/theory/integration.md (11a).
 */
class EnergyBalance
{
public:
  explicit EnergyBalance(const SecondOrderSystem &system);

  void begin(const Instant &instant);
  /// Called once per accepted step.
  void step(const Instant &instant); ///< trapezoidal
  /// @param exchanged  [J] so far, the reference for an open balance of a step
  void step(const TimeIntegrator &integrator, const PowerRule &rule, double exchanged);
  /// Forces have changed their branch at the instant of the last step: the loss of stored energy is dissipated.
  void   jump(const Instant &instant);
  double at_begin() const { return stored_begin_; } ///< [J], reference of the stored energy
  /// At the end of the last step, or at an instant inside it: integrals by the cubic through both ends and their
  /// powers, which is monotonic if both ends indicate growth.
  EnergyState state(const Instant &instant);
  /// The same after a step with Gauss' rule: from the start of the panel to the instant by the same rule.
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
  Power                    work_begin_, work_; // integrals, at both ends of the last step
  std::vector<Power>       panels_;            // integrals at the ends of equal parts of the last step
  double                   t_begin_ = 0., t_ = 0.;
  double                   stored_last_ = 0., stored_ = 0.; // at both ends of the last step, if it uses Gauss' rule
  double                   stored_begin_ = 0., in_elements_ = 0., forces_ = 0.; // in_elements_ at the end of the step
  Eigen::VectorXd          kinetic_, kinetic_begin_; // of every coordinate, at the instant of the last call of stored()
};

} // namespace gestell::coupling

#pragma once

#include "coupling/integration/method_options.h"
#include "coupling/integration/stability/characteristic_roots.h"
#include "coupling/integration/stability/test_oscillator.h"
#include "coupling/integration/system/time_integrator.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// Parameter of a method besides step and tolerance.
struct MethodParameter
{
  std::string                 name;     ///< "rho_inf"
  std::string                 meaning;  ///< one clause
  double                      fallback; ///< default
  std::string                 range;    ///< "between 0 and 1": it must be ...
  std::function<bool(double)> valid;
  std::vector<std::string>    choices{}; ///< of strings; the first is the default, and fallback, range, valid are empty
};

/// A setting of a method for work-precision charts.
struct ChartSetting
{
  std::string   key; ///< "bdf-2-controlled"
  MethodOptions options;
  bool          controlled = false; ///< the tolerance is varied, not the step
  bool          on_request = false; ///< shown only on request
};

/**
 * Weights of a motion x r^k in the balance of a one-step method that averages no forces: Newmark, central differences,
 * Wilson.  Accelerations x, and with them velocities and displacements, fulfil
 *
 *     (mass(r) M + damping(r) h B + stiffness(r) h^2 C) x = 0.
 *
 * Their sign is chosen so that all are positive for large negative r.
 */
struct StepWeights
{
  double mass, damping, stiffness;
};

/// The same balance in z = (r - 1)/(r + 1):  (4 M + 2 c h B + d h^2 C) z^2 + (2 h B + c h^2 C) z + h^2 C.
struct BilinearWeights
{
  double c, d;
};

/**
 * A method of time integration, as listed by integration_methods(): its parameters, its integrator, and its step for
 * the test oscillator.  Help, scenes, charts, stability maps and the stability check use only this interface, not the
 * individual methods.
 *
 * Its arguments are options with its name; check() is called before make().
 */
class IntegrationMethod
{
public:
  virtual ~IntegrationMethod() = default;

  virtual std::string name() const    = 0; ///< run.method of scenes
  virtual std::string meaning() const = 0; ///< a sentence, with the source of its formulas

  virtual const std::vector<MethodParameter> &parameters() const; ///< none by default
  virtual bool                                takes_order() const { return false; }
  /// Default order; 0: with these options there is only one.
  virtual int  default_order(const MethodOptions &) const { return 0; }
  virtual bool can_control_error() const { return false; }

  /// "BDF 2", "generalised alpha 0.8"
  virtual std::string label(const MethodOptions &options) const = 0;
  /// Checks in addition to step, tolerance and the ranges of parameters().
  /// @throws std::invalid_argument with the parameter, its value and the allowed range
  virtual void check(const MethodOptions &) const {}
  /// @throws std::invalid_argument if the method cannot treat the system, with the reason
  virtual std::unique_ptr<TimeIntegrator> make(const SecondOrderSystem &system, const MethodOptions &options) const = 0;

  /**
   * The step as a matrix on the state of the method, lengths in units of x, times in units of h: (x, h x') or (x, h x',
   * h^2 x'') for one-step methods, for others a state that begins with x.
   */
  virtual Eigen::MatrixXd amplification_matrix(const MethodOptions  &options,
                                               const TestOscillator &oscillator) const = 0;
  /// Its roots; by default the eigenvalues of the matrix, where growth below the rounding error 1e-13 is ignored.
  virtual CharacteristicRoots roots(const MethodOptions &options, const TestOscillator &oscillator) const;
  /// (x, h x') after 1, 2, ... n steps, from consistent accelerations; by default with the matrix of the first step.
  virtual std::vector<Eigen::Vector2d> first_steps(const MethodOptions &options, const TestOscillator &oscillator,
                                                   const Eigen::Vector2d &start, int n, FirstSteps kind) const;
  /// For methods that do not integrate modes separately.
  virtual std::optional<StepWeights> step_weights(const MethodOptions &, double r) const
  {
    return (void)r, std::nullopt;
  }
  /// For vibrations that can grow: methods with step_weights() and less damping than a method of second order.
  virtual std::optional<BilinearWeights> growing_weights(const MethodOptions &) const { return {}; }

  /// The linear base system is propagated exactly: only the springs of elements limit the step.
  virtual bool carries_base() const { return false; }
  /// Steps may be long compared with the motion, as for methods of high order.
  virtual bool takes_long_steps(const MethodOptions &options) const { return controlled(options); }
  /// How to conserve energy better than with `options`, in a sentence; empty: only a smaller step helps.
  virtual std::string energy_advice(const MethodOptions &) const { return ""; }

  virtual std::string               family() const = 0; ///< of charts: methods with one colour
  virtual std::vector<ChartSetting> chart_settings() const { return {{name(), named(), false}}; }

  double      number(const MethodOptions &options, const std::string &parameter) const;
  std::string choice(const MethodOptions &options, const std::string &parameter) const;

protected:
  /// Options with the name of this method.
  MethodOptions named() const;

private:
  const MethodParameter &parameter(const std::string &name) const;
};

/// @throws std::invalid_argument "BDF 7: order is 7; it must be 1 to 6" unless valid
void require_parameter(bool valid, const std::string &method, const std::string &parameter, double value,
                       const std::string &needed);

} // namespace gestell::coupling

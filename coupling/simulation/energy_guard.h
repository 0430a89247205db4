#pragma once

#include "coupling/integration/system/energy_balance.h"

#include <algorithm>
#include <string>

namespace gestell::coupling
{

class StateArchive;

/**
 * Checks the energy balance of a run: compares its residual with the energy that the motion exchanges,
 *
 *     E = max( kinetic energy that coordinates gained or lost, |stored|, range of input + range of dissipated ),
 *
 * the largest of each so far.  For a long vibration E is its own energy, for a driven machine the work transmitted; a
 * load whose work is returned in every period does not increase E.  The balance counts as closed if the residual is
 * below the rounding errors of N steps, N epsilon sum|f| max(|q|, 1), or below a millionth of the initial energy.
 *
 * Source: docs/theory/integration.md (11a).
 */
class EnergyGuard
{
public:
  enum class Verdict
  {
    closed,   ///< within one per cent of E
    open,     ///< the step is too long for the motion
    no_motion ///< spurious energy gain of at least half of E, or a loss of more than the available energy
  };

  /// @param at_begin  initial stored energy [J] of the balance
  explicit EnergyGuard(double at_begin = 0.) : at_begin_(at_begin) {}

  /// Called once per step.
  /// @param size  largest |q|
  /// @throws ConvergenceFailure if the energy is not finite
  void step(const EnergyState &state, double size);

  double  exchanged() const; ///< E [J]
  double  residual() const;  ///< largest |residual| so far [J]
  Verdict verdict() const;
  /// Description of the residual, empty if the balance is closed.
  /// @param method  name with its step, for messages: "BDF 2 with a step of 0.001 s"
  std::string words(const std::string &method) const;

  void exchange(StateArchive &archive);

private:
  /// Range of a quantity that starts at zero.
  struct Range
  {
    double least = 0., most = 0.;

    void   add(double value) { least = std::min(least, value), most = std::max(most, value); }
    double length() const { return most - least; }
  };

  double at_begin_ = 0.;
  double gain_ = 0., loss_ = 0.; ///< largest -residual and residual
  double largest_ = 0., rounding_ = 0.;
  Range  input_, dissipated_;
  long   steps_ = 0;
};

} // namespace gestell::coupling

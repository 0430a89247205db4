#pragma once

#include "coupling/integration/system/energy_balance.h"

#include <algorithm>
#include <string>

namespace gestell::coupling
{

class StateArchive;

/**
 * Says whether the energy balance of a run is open: its residual against the energy that the motion exchanges,
 *
 *     E = max( kinetic energy that coordinates gained or lost, |stored|, range of input + range of dissipated ),
 *
 * the largest of each so far.  A vibration that goes on for long is so measured by its own energy, a machine that is
 * driven by the work that went through it; what a load gives and takes back in every period adds nothing.  Below the
 * rounding of N steps, N epsilon sum|f| max(|q|, 1), or a millionth of the energy it began with, nothing is open.
 *
 * Source: docs/theory/integration.md (11a).
 */
class EnergyGuard
{
public:
  enum class Verdict
  {
    closed,   ///< to one per cent of E
    open,     ///< the step is too long for the motion
    no_motion ///< spurious energy gain of at least half of E, or a loss of more than there was
  };

  /// @param at_begin  stored energy [J] that the balance counts from
  explicit EnergyGuard(double at_begin = 0.) : at_begin_(at_begin) {}

  /// Once per step.
  /// @param size  largest |q|
  /// @throws ConvergenceFailure if the energy is not finite
  void step(const EnergyState &state, double size);

  double  exchanged() const; ///< E [J]
  double  residual() const;  ///< largest |residual| so far [J]
  Verdict verdict() const;
  /// What is open and by what, empty if closed.
  /// @param method  with its step, for messages: "BDF 2 with a step of 0.001 s"
  std::string words(const std::string &method) const;

  void exchange(StateArchive &archive);

private:
  /// Of a quantity that begins with zero.
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

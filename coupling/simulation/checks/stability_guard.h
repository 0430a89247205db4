#pragma once

#include "coupling/integration/integration_methods.h"
#include "coupling/modes/linear_spectrum.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Effect of a method with a fixed step on one mode.
struct ModeAccuracy
{
  ModeOrigin   origin;
  int          number; ///< from 1, by frequency; modes that do not vibrate are counted too
  SpectrumLine mode;
  double       omega_h;           ///< omega h; with exact propagation, of the stiffness of the contact only
  double       spectral_radius;   ///< > 1: growth factor of every step
  double       numerical_damping; ///< damping ratio beyond the physical one; nan if the solution does not vibrate
  double       period_error;      ///< relative, > 0: too slow; nan as above
  bool         unstable;          ///< grows by more than 1e-10 per step: e^0.1 in 1e9 steps
  bool         bound = false;     ///< upper bound for modes that are not known individually
};

/// The spectrum for the guard: empty if the step is controlled, or if the machine is large and the method is
/// unconditionally stable.
LinearSpectrum spectrum_for(const Machine &machine, const InitialState &start, const MethodOptions &options);

/**
 * Checks the stability of a method with its fixed step for the linearised machine before a run, with open and with
 * closed contacts, in the DOFs that joints leave free, including dampers that couple the modes.
 *
 * - BDF integrates each complex mode separately: its scalar formula at omega = |s|, zeta = -Re s/|s| decides.
 * - Newmark's method, central differences and Wilson's method do not: a motion x r^k with real r < -1 grows if m(r) M +
 *   b(r) h B + c(r) h^2 C is not positive definite, and for gamma >= 1/2 no other motion can grow
 * (docs/theory/stability.md). For Newmark's method with gamma < 1/2 the complex modes of the machine that is equivalent
 * to its step are also checked.
 * - HHT and generalised alpha are stable with every step, for any dampers.
 * - With follower forces definiteness does not decide; the roots r of all modes together do: growing_step().
 * - Exact propagation approximates only the stiffness of elements, which contributes omega_c^2 = v^T K v to omega^2 of
 *   the mode v.  The growth is that of a contact oscillator at omega_c h; period error and numerical damping are those
 *   of this oscillator times omega_c^2/omega^2, to first order.
 *
 * Negative damping ratios are set to zero: physical growth is not an error of the method.  Modes without stiffness do
 * not vibrate and are omitted.
 */
class StabilityGuard
{
public:
  /// Not active if the step is controlled (options.tolerance > 0).
  /// @param spectrum  must outlive the guard
  StabilityGuard(const LinearSpectrum &spectrum, const MethodOptions &options);

  /// Every vibrating mode in the numerical solution: with open, then with closed contacts.
  const std::vector<ModeAccuracy> &modes() const { return modes_; }

  /**
   * Rejects the run if a motion grows, also if it grows only with closed contacts.  Exact propagation is an exception:
   * its base system never grows, and contacts are closed for few steps only, so that order and tolerance matter more;
   * see warnings().
   *
   * @throws std::invalid_argument with the word `unstable`, the fastest growing mode, its frequency and damping ratio,
   * the unstable interval of omega h, its growth per step, and the remedy: a step or a method that works, and
   * run.force_unstable.
   */
  void check() const;

  /// Warnings of a run that is accepted: modes of closed contacts that grow with exact propagation as long as the
  /// contact is closed.
  std::vector<std::string> warnings() const;

  /// The largest step below options.step, to three digits, with which no motion grows; 0 if there is none above a
  /// thousandth of it.
  double largest_stable_step() const;

private:
  void                add_machine(const LinearMachine &machine);
  void                add_large();
  bool                motion_grows(double h) const;
  bool                mode_grows(double h) const;
  double              by_ladder() const;
  double              by_bisection() const;
  const ModeAccuracy *fastest() const;
  std::string         message_of(const ModeAccuracy &worst) const;

  const LinearSpectrum     &spectrum_;
  MethodOptions             options_;
  std::vector<ModeAccuracy> modes_;
};

} // namespace gestell::coupling

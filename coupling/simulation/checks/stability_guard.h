#pragma once

#include "coupling/integration/integration_methods.h"
#include "coupling/modes/linear_spectrum.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// What a method with a fixed step makes of one mode.
struct ModeAccuracy
{
  ModeOrigin   origin;
  int          number; ///< from 1, by frequency, those that do not vibrate counted as well
  SpectrumLine mode;
  double       omega_h;           ///< omega h; under exact propagation that of the contact's stiffness alone
  double       spectral_radius;   ///< > 1: grows in every step by this factor
  double       numerical_damping; ///< ratio, beyond the physical one; nan where the method's motion does not vibrate
  double       period_error;      ///< relative, > 0: too slow; nan as above
  bool         unstable;          ///< grows by more than 1e-10 in a step: e^0.1 in 1e9 steps
  bool         bound = false;     ///< stands for modes that are not known one by one
};

/// What the guard looks at: nothing where the step is controlled, or where the machine is large and the method stable
/// at every step.
LinearSpectrum spectrum_for(const Machine &machine, const InitialState &start, const MethodOptions &options);

/**
 * Lays the linear machine over a method with its fixed step before a run, base and with closed contacts, as the
 * integrator sees them: in the motions that joints leave free, with the dampers that couple the modes.
 *
 * - BDF takes each complex mode by itself: its scalar formula at omega = |s|, zeta = -Re s/|s| decides.
 * - Newmark's method, central differences and Wilson's do not: a motion x r^k with real r < -1 grows where
 *   m(r) M + b(r) h B + c(r) h^2 C is not positive definite, and for gamma >= 1/2 no other can (docs/stability.md).
 *   Newmark's method with gamma < 1/2 takes, besides, the complex modes of the machine that its step amounts to.
 * - HHT and generalised alpha are stable at every step, for any dampers.
 * - Where forces follow the motion, the roots r of all modes together decide in place of definiteness: growing_step().
 * - Exact propagation approximates the stiffness of elements only, in the mode v by omega_c^2 = v^T K v of omega^2:
 *   growth is that of a contact oscillator at omega_c h, period error and numerical damping are its own times
 *   omega_c^2/omega^2, in first order.
 *
 * Negative damping ratios count as zero: what grows by itself is no fault of the method.  Modes without stiffness do
 * not vibrate and are left out.
 */
class StabilityGuard
{
public:
  /// Looks at nothing where the step is controlled (options.tolerance > 0).
  /// @param spectrum  outlives the guard
  StabilityGuard(const LinearSpectrum &spectrum, const MethodOptions &options);

  /// Every vibrating mode as the method carries it: base, then closed.
  const std::vector<ModeAccuracy> &modes() const { return modes_; }

  /**
   * Refuses the run if a motion grows.  Closed contacts stop a run as well, except with exact propagation: there the
   * base system never grows, and a contact that is left because its force is wrong is closed for few steps only, where
   * order and tolerance matter more; see warnings().
   *
   * @throws std::invalid_argument that says `unstable` and names the fastest growing mode, its frequency and damping
   * ratio, the unstable interval of omega h, its growth per step, and the way out: a step or a method that works, and
   * run.force_unstable.
   */
  void check() const;

  /// What a run should tell although it is not refused: modes of closed contacts that exact propagation makes grow as
  /// long as the contact stays closed.
  std::vector<std::string> warnings() const;

  /// The largest step below options.step, to three digits, at which nothing grows; 0 if there is none down to a
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

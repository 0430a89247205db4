#pragma once

#include "coupling/integration/method.h"
#include "coupling/linear_spectrum.h"
#include "coupling/machine.h"
#include "coupling/steady_start.h"

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

/**
 * All vibrating modes of the base system and, for dense models, of the machine with its elements engaged at `initial`,
 * each as the method of `options` with its fixed step carries it.  Empty where the step is controlled
 * (options.tolerance > 0), and for unreduced frames and mechanisms of more than 600 coordinates under methods that are
 * stable at every step.
 *
 * BDF from order 3 on takes the complex eigenvalues, others undamped modes with their own share of damping.  Negative
 * damping ratios count as zero: what grows by itself is no fault of the method.
 *
 * Under exact propagation only the stiffness of elements is approximated, in the mode v by omega_c^2 = v^T K v of
 * omega^2: growth is that of a contact oscillator at omega_c h, period error and numerical damping are its own times
 * omega_c^2 / omega^2, in first order.
 */
std::vector<ModeAccuracy> mode_accuracy(const Machine &machine, const InitialState &initial,
                                        const MethodOptions &options);

/**
 * Lays `modes` (of mode_accuracy()) over the unstable intervals of the method and refuses the run if one of them grows.
 *
 * Modes without stiffness do not vibrate and are left out.  Modes of the machine with closed contacts stop a run as
 * well, except with exact propagation: there the base system never grows, and a contact that is left because its force
 * is wrong is closed for few steps only, where order and tolerance matter more; see stability_warnings().
 *
 * @throws std::invalid_argument that says `unstable` and names the fastest growing mode, its frequency and damping
 * ratio, the unstable interval of omega h, its growth per step, and the way out: a step or a method that works, and
 * run.force_unstable.
 */
void check_stability(const std::vector<ModeAccuracy> &modes, const MethodOptions &options);

/// What a run should tell although it is not refused: modes of closed contacts that exact propagation makes grow as
/// long as the contact stays closed.
std::vector<std::string> stability_warnings(const std::vector<ModeAccuracy> &modes, const MethodOptions &options);

/// The largest step below options.step, to three digits, at which no mode of `modes` grows; 0 if there is none down to
/// a thousandth of it.
double largest_stable_step(const std::vector<ModeAccuracy> &modes, const MethodOptions &options);

} // namespace gestell::coupling

#pragma once

#include "coupling/integration/method.h"
#include "coupling/machine.h"
#include "coupling/steady_start.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Which linear machine a mode belongs to.
enum class ModeOrigin
{
  base,  ///< the base system: frame and bodies, elements open
  closed ///< with the elements engaged at the start configuration
};

/// What a method with a fixed step makes of one mode.
struct ModeAccuracy
{
  ModeOrigin   origin;
  int          number; ///< from 1, by frequency
  SpectrumLine mode;
  double       omega_h;
  double       spectral_radius;   ///< > 1: grows in every step by this factor
  double       numerical_damping; ///< ratio, beyond the physical one
  double       period_error;      ///< relative, > 0: too slow
  bool         unstable;
};

/**
 * All vibrating modes of the base system and, for dense models, of the machine with its elements engaged, each as the
 * method of `options` with its fixed step carries it.  Empty where the step is controlled (options.tolerance > 0).
 */
std::vector<ModeAccuracy> mode_accuracy(const Machine &machine, const InitialState &initial,
                                        const MethodOptions &options);

/**
 * Lays the modes over the unstable intervals of the method and refuses the run if one of them grows.
 *
 * Modes without stiffness do not vibrate and are left out; what grows by less than 1e-10 per step (e^0.1 in 1e9 steps)
 * counts as steady.  Modes of the machine with closed contacts stop a run as well, except with exact propagation: its
 * modes of the base system never grow, and a contact is closed for a while only; see stability_warnings().
 *
 * @throws std::invalid_argument that says `unstable` and names the fastest growing mode, its frequency and damping
 * ratio, the unstable interval of omega h, its growth per step, and the way out: a step or a method that works, and
 * run.force_unstable.
 */
void check_stability(const Machine &machine, const InitialState &initial, const MethodOptions &options);

/// What a run should tell although it is not refused: modes of closed contacts that exact propagation makes grow as
/// long as the contact stays closed.
std::vector<std::string> stability_warnings(const Machine &machine, const InitialState &initial,
                                            const MethodOptions &options);

} // namespace gestell::coupling

#pragma once

#include "coupling/equilibrium/steady_start.h"
#include "coupling/machine/machine.h"
#include "coupling/modes/damped_modes.h"

namespace gestell::coupling
{

/// The linear machine of a mode.
enum class ModeOrigin
{
  base,  ///< frame and bodies, with elements in their open branch
  closed ///< with every element in the stiffest branch of its law, at the start configuration
};

/**
 * The machine linearised at rest in the initial configuration, in its undamped modes V, V^T M V = E:
 *
 *     y'' + B y' + diag(omega^2) y = 0,     q = Z V y,     B = V^T Z^T B Z V [p x p]
 *
 * where Z spans the motions that joints allow; geometric stiffness of joints and elements is part of C.  With follower
 * forces it is not symmetric: V are those of circulatory_modes(), B and C [p x p] refer to the dual basis, and C
 * replaces diag(omega^2).
 */
struct LinearMachine
{
  ModeOrigin      origin;
  DenseModes      modes;
  Eigen::MatrixXd B;
  Eigen::VectorXd contact_omega; ///< [p] rad/s, sqrt(v^T K v): contribution of the elements alone
  Eigen::MatrixXd C;             ///< empty: diag(omega^2)
};

/// A mode of a machine that is too large for dense matrices.
struct LargeMode
{
  ModeOrigin   origin;
  int          number; ///< from 1, by frequency; modes that do not vibrate are counted too
  SpectrumLine line;
  bool         bound = false; ///< represents all modes up to its frequency, not known individually
};

/**
 * Modes relevant to an integrator with a fixed step: base and, if different, closed.
 *
 * A frame that is too large for dense matrices gives its lowest modes and, as a `bound`, the highest one with closed
 * contacts, by power iteration.
 */
struct LinearSpectrum
{
  std::vector<LinearMachine> machines; ///< none of a large machine
  std::vector<LargeMode>     large;
};

/// @throws std::invalid_argument as dense_modes() does
LinearSpectrum linear_spectrum(const Machine &machine, const InitialState &start);

/// Whether a machine has too many coordinates for dense matrices.
bool is_large(const Machine &machine);

} // namespace gestell::coupling

#pragma once

#include "coupling/machine.h"

namespace gestell::coupling
{

/// Which linear machine a mode belongs to.
enum class ModeOrigin
{
  base,  ///< the base system: frame and bodies, elements open
  closed ///< with every element in the stiffest branch of its law, at the start configuration
};

/// A vibrating mode of the machine, for an integrator.
struct LinearMode
{
  ModeOrigin   origin;
  int          number; ///< from 1, by frequency, those that do not vibrate counted as well
  SpectrumLine line;
  double       contact_omega; ///< [rad/s] sqrt(v^T K v), v^T M v = 1: what the engaged elements alone contribute
  bool         bound = false; ///< stands for all modes up to its frequency, which are not known one by one
};

/// How the damping of a mode is told.
enum class DampingRule
{
  diagonal, ///< v^T B v / (2 omega) of the undamped mode
  exact     ///< from the complex eigenvalues s: omega = |s|, zeta = -Re s / |s|; modes that only decay are left out
};

/**
 * All vibrating modes of the base system, and of the machine with its elements engaged at q where that differs.
 *
 * A frame that is too large for dense matrices gives its lowest modes and, as a `bound`, the highest one by power
 * iteration; its elements are taken as open.
 */
std::vector<LinearMode> linear_modes(const Machine &machine, const Eigen::VectorXd &q, DampingRule rule);

} // namespace gestell::coupling

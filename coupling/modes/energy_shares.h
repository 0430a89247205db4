#pragma once

#include "coupling/modes/modes.h"

namespace gestell::coupling
{

/**
 * Distribution of the energies of modes.  For a mode v with v^T M v = 1 and v^T K v = omega^2, the shares of a spring p
 * of stiffness K_p and of the coordinates I of a body are
 *
 *     strain:   v^T K_p v / omega^2,     kinetic:   sum_{i in I} v_i (M v)_i,
 *
 * each with the sum 1.  Springs are the frame on its supports, linear elements, and nonlinear ones in their engaged
 * state; geometric stiffness is a further share and may be negative.  The mass of a body that moves with a marker of
 * the frame is part of the frame.  Strain shares of a mode with frequency zero are nan, and all shares of a flutter
 * mode, whose energies are not constant.
 */
struct EnergyShares
{
  std::vector<std::string> springs; ///< "frame", elements by name, "turning forces"; those without a share are omitted
  Eigen::MatrixXd          strain;  ///< [springs x modes]
  std::vector<std::string> masses;  ///< "frame", bodies by name
  Eigen::MatrixXd          kinetic; ///< [masses x modes]
};

/// Signals of a linear element: c u, with its own sign, and u.
struct LinearSpring
{
  std::string name;
  Measure     force, displacement; ///< weights [N/m or N m/rad], [1] of the coordinates
};

/// The springs and dampers of the base system, in the order of their names.
std::vector<LinearSpring> linear_springs(const MachineModel &model);

/// Shares of modes from linearised_modes() at q with the elements `open` not engaged.
EnergyShares energy_shares(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                           const std::vector<Mode> &modes);

} // namespace gestell::coupling

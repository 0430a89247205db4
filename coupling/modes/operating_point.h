#pragma once

#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"
#include "coupling/periodic/response/linear_response.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// A machine at an instant of its motion, linearised for small vibrations.
struct MachinePoint
{
  InitialState             state;
  Eigen::VectorXd          a; ///< q'' [n] of the motion; zero for massless coordinates
  OperatingPoint           point;
  std::vector<std::string> closed, open; ///< names of elements with clearance, in contact and not in contact
  std::vector<std::string> touching;     ///< elements whose force has a kink at the point: about to touch
};

/// The motion `state` with its forces, multipliers and accelerations; branches of the laws are the initial ones of a
/// run from there, and remain set in the machine.
/// @throws ConvergenceFailure if joints are redundant there
MachinePoint machine_point(Machine &machine, const InitialState &state);

/**
 * A signal linearised about a point.  Weights of coordinates and of linear elements are exact; quantities of nonlinear
 * elements are differentiated in their measures, forces and multipliers by quotients extrapolated to zero step,
 * measures of position functions by their gradient.
 *
 * @throws std::invalid_argument if a quantity is not smooth there
 */
LinearAnswer linear_signal(const Machine &machine, const Signal &signal, const MachinePoint &at);

/// Generalised force [n] of a unit force (or torque) along a signal that is a displacement or an angle: its gradient.
/// @throws std::invalid_argument if the signal depends on anything but the position
Eigen::VectorXd force_along(const Machine &machine, const Signal &signal, const MachinePoint &at);

} // namespace gestell::coupling

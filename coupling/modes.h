#pragma once

#include "coupling/machine.h"

namespace gestell::coupling
{

struct Mode
{
  double          frequency_hz = 0., damped_frequency_hz = 0.;
  double          damping_ratio = 0.; ///< nan where the mode does not vibrate
  Vector3         effective_mass{};   ///< [kg] x, y, z
  Eigen::VectorXd shape;              ///< undamped, mass normalised, in the coordinates it belongs to
};

/// Modes of the frame alone as it is supported, interface free; shapes in the frame's coordinates.  An unreduced frame
/// gives its lowest n_modes.
std::vector<Mode> frame_modes(const Machine &machine, int n_modes);

/// Modes of the coupled machine linearised at q: base system plus engaged elements (all but those named in `open`),
/// without geometric stiffness.  With ideal joints: in the motions they leave free, with the geometric stiffness of the
/// forces that act at q.  Shapes in the machine's coordinates.
std::vector<Mode> coupled_modes(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                                int n_modes);

} // namespace gestell::coupling

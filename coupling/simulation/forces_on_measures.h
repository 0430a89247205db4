#pragma once

#include "coupling/machine/machine.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/// Forces p [n_u] on the measures of all elements at a motion: of laws by their values, of joints and of what sticks as
/// the motion carries them.
void forces_on_measures(const Machine &machine, const LocalState &local, Eigen::VectorXd &p);

} // namespace gestell::coupling

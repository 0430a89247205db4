#pragma once

#include "coupling/machine/machine.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/// Forces p [n_u] on the measures of all elements for a motion: from the values of laws; for joints and sticking
/// elements from the motion.
void forces_on_measures(const Machine &machine, const LocalState &local, Eigen::VectorXd &p);

} // namespace gestell::coupling

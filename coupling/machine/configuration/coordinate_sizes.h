#pragma once

#include "coupling/machine/machine.h"

namespace gestell::coupling
{

/// [m] largest distance, along a global axis, between bodies and interfaces; 1 m if all positions coincide, as in a
/// scene of masses without positions.
double machine_length(const MachineModel &model);

/// Number of displacements among the coordinates of a body: the first ones.
int n_displacements(BodyKind kind);

/// Scale of a large motion of each coordinate [n]: machine_length() for displacements, 1 for angles, directors and
/// states of elements.  Motions divided by it are dimensionless.
Eigen::VectorXd coordinate_sizes(const Machine &machine);

/// The same of each measure of an element.
double measure_size(const MachineModel &model, const ElementPlacement &placement);

/// [1/s] largest |v_i|/size_i: speed in sizes per second.
double relative_speed(const Machine &machine, const Eigen::VectorXd &v);

} // namespace gestell::coupling

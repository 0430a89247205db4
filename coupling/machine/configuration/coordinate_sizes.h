#pragma once

#include "coupling/machine/machine.h"

namespace gestell::coupling
{

/// [m] largest distance, along an axis of space, between places of bodies and interfaces; 1 m where all are one, as in
/// a scene of masses that gives no positions.
double machine_length(const MachineModel &model);

/// Displacements among the coordinates of a body: the first ones.
int n_displacements(BodyKind kind);

/// What a large motion of each coordinate is [n]: machine_length() of displacements, 1 of angles, directors and states
/// of elements.  Motions divided by them are numbers, the same in any unit of length.
Eigen::VectorXd coordinate_sizes(const Machine &machine);

/// The same of each measure of an element.
double measure_size(const MachineModel &model, const ElementPlacement &placement);

/// [1/s] largest |v_i|/size_i: how many of its sizes a coordinate moves in a second.
double relative_speed(const Machine &machine, const Eigen::VectorXd &v);

} // namespace gestell::coupling

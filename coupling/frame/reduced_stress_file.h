#pragma once

#include "coupling/frame/hdf5_file.h"
#include "coupling/frame/reduced_stress.h"

namespace gestell::coupling
{

/// Writes the group "stress/" of the file of a reduced frame; no effect without stresses.
void write_stress(Hdf5File &file, const ReducedStress &stress);

/// Reads it; empty if the file has none.
/// @param n_points  number of points of the picture; n  number of coordinates of the reduced frame.
/// @throws std::runtime_error if its sizes contradict these.
ReducedStress read_stress(const Hdf5File &file, int n_points, int n);

} // namespace gestell::coupling

#pragma once

#include "coupling/frame/hdf5_file.h"
#include "coupling/frame/reduced_stress.h"

namespace gestell::coupling
{

/// Writes the group "stress/" of the file of a reduced frame; nothing if there is none.
void write_stress(Hdf5File &file, const ReducedStress &stress);

/// Reads it; empty if the file has none.
/// @param n_points  of the picture, n  coordinates of the reduced frame.
/// @throws std::runtime_error if it does not fit these.
ReducedStress read_stress(const Hdf5File &file, int n_points, int n);

} // namespace gestell::coupling

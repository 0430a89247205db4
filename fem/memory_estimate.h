#pragma once

#include <string>

namespace gestell::fem
{

/// Memory [byte] that mesh, assembly and reduction of a frame of n coordinates take at their peak,
///     0.25 GiB + 6 kB n (n / 150 000)^0.15,
/// measured: 1.2 GiB at 154 000 coordinates (the formula 1.2), 8.9 GiB at 975 000 (7.5).
double reduction_memory(double n_coordinates);

/// Memory [byte] this process may still take: what the system has available, or its container allows; infinite where
/// neither tells.
double available_memory();

/// Coordinates of a quadratic mesh of so many tetrahedra, within 20 %.
double coordinates_of(double n_tetrahedra);

/// @throws std::invalid_argument if the mesh to be expected needs more memory than there is.
/// @param advice  what would do, such as "use size = 0.1 m or more"
void require_memory(double n_tetrahedra, double available, const std::string &place, const std::string &advice);

/// "1.2 GiB"
std::string memory_text(double bytes);

} // namespace gestell::fem

#pragma once

#include "fem/values/available_memory.h"

#include <string>

namespace gestell::fem
{

/// kappa = 2 V^(2/3) / A of a body of volume V [m^3] and skin A [m^2]: 1/3 for a cube, 0.07 for a welded press frame,
/// 0.03 for thin plates; at most that of a sphere.
double compactness(double volume, double skin_area);

/**
 * Peak memory [byte] of mesh, assembly and reduction of a frame with n DOFs,
 *
 *     0.22 GiB + 0.37 GiB N + 3.8 GiB kappa N^(4/3) + 50 kB n_a,     N = n / 100 000:
 *
 * for the libraries; for mesh, matrices and vectors of 40 modes, proportional to the DOFs; and for the factor of C.
 * With nested dissection of a body its entries grow like n^(4/3) (George, SIAM J. Numer. Anal. 10, 1973, 345-363); for
 * plates the separators are smaller in proportion to the thickness 2 V / A.  The formula is fitted to the press frame,
 * 3 to 4 % above the measured value (docs/develop/benchmarks.md); it is 3 % too low for the ladder chassis, and a tenth
 * to a third too high for cubes and beams.  Each of the n_a nodes averaged by an interface has three rows with the 192
 * displacements of its group in M, in C and in the factor: 48 and 50 kB were measured on plates with a whole face
 * averaged.
 */
double reduction_memory(double n_coordinates, double kappa, double n_averaged = 0.);

/**
 * What a frame about its prestressed state needs in addition: C without prestress and the geometric stiffness, while
 * the second discretisation is made beside the factor of C,
 *
 *     0.2 GiB N.
 *
 * 0.17 GiB N was measured for a beam of 47 000 DOFs in tetrahedra.
 */
double prestress_memory(double n_coordinates);

/// Number of nodes on an area [m^2] of quadratic triangles of this size [m]: two per triangle.
double nodes_on(double area, double size);

/// Number of DOFs of a quadratic mesh with this number of tetrahedra, within 20 %.
double coordinates_of(double n_tetrahedra);

/// @param what    subject of the message, such as "the mesh has 30000 coordinates"
/// @param advice  remedy, such as "Use size = 0.1 m or more."
/// @throws std::invalid_argument if more memory is needed than is available.
void require_memory(const std::string &what, double needed, double available, const std::string &place,
                    const std::string &advice);

} // namespace gestell::fem

#pragma once

#include <array>
#include <complex>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A function of frequency from a data set 58 of a universal file.
struct UniversalFunction
{
  std::string                       name;             ///< its first line
  int                               line        = 0;  ///< number of its first line in the file
  int                               derivatives = -1; ///< 0 displacement, 1 velocity, 2 acceleration; -1: unknown
  bool                              is_complex  = true;
  std::vector<double>               abscissa; ///< [Hz]
  std::vector<std::complex<double>> values;
};

/**
 * The data sets 58 (function at nodal DOF) of a universal file in ASCII: real or complex, of even or uneven spacing, in
 * single or double precision; other data sets are skipped.
 *
 * Source: Universal Dataset Number 58, Structural Dynamics Research Laboratory, University of Cincinnati, 30-Jun-1999.
 *
 * @throws std::invalid_argument with file and line for binary sets (58b), abscissae other than frequency, values that
 *         contradict the header, units other than SI (data set 164), or a file without data set 58
 */
std::vector<UniversalFunction> read_universal_functions(const std::string &file);

/// A measured or computed mode from a data set 55 of a universal file.
struct UniversalMode
{
  int                                line = 0;           ///< number of its first line in the file
  double                             hz = 0., zeta = 0.; ///< undamped frequency, share of critical damping
  std::vector<std::array<double, 3>> points;             ///< [m] global, of its nodes; none if the file has no nodes
  std::vector<std::complex<double>>  shape;              ///< [3 nodes] translations x, y, z
};

/**
 * The modes of the data sets 55 (data at nodes) of normal or complex modes, with the nodes of the data sets 15 or 2411;
 * other data sets are skipped, and data sets 55 of other analyses.
 *
 * Source: Universal Dataset Numbers 55, 15 and 2411, Structural Dynamics Research Laboratory, University of Cincinnati.
 *
 * @throws std::invalid_argument with file and line for a node without coordinates, values that contradict the header,
 *         units other than SI (data set 164), or a file without modes
 */
std::vector<UniversalMode> read_universal_modes(const std::string &file);

} // namespace gestell::apps

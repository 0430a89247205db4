#pragma once

#include "fem/assembly/raised_degree.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/**
 * Lowest elastic frequencies of a frame in elements of degree three [rad/s], by one step of inverse iteration from its
 * modes X [n x k] in quadratic ones and a projection,
 *
 *     (C3 + s M3) Y = M3 X,     (Y^T C3 Y) g = omega^2 (Y^T M3 Y) g.
 *
 * Because the functions of degree three include the quadratic ones, the j-th frequency is below that of the quadratic
 * mesh, and like it above that of the continuum.
 *
 * @param omega      of the modes X, ascending
 * @param floats     whether there are rigid-body modes, to which the modes are M-orthogonal
 * @param available  memory for the factor [byte]
 * @param factor     see make_factor()
 * @throws NotEnoughMemory, NotPositiveDefinite
 *
 * Source: docs/theory/mesh_error.md (4a).
 */
Eigen::VectorXd raised_frequencies(fem::RaisedFrame frame, const Eigen::MatrixXd &X, const Eigen::VectorXd &omega,
                                   bool floats, double available, const std::string &factor = "");

/// Error of a frequency of the quadratic mesh from that of degree three, relative to the latter:
/// docs/theory/mesh_error.md (4b).
double error_by_raising(double omega, double raised);

} // namespace gestell::coupling

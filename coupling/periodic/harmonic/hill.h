#pragma once

#include "coupling/periodic/harmonic/harmonic_forces.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/// Floquet multipliers of a motion that is known as a Fourier series.
struct HillMultipliers
{
  Eigen::VectorXcd multipliers;    ///< [2n], largest first
  int              harmonics = 0;  ///< N of Hill's matrix
  double           left_out  = 0.; ///< size of the solution in its outermost harmonics: the error of the truncation
};

/**
 * Multipliers from Hill's matrix.  The neighbourhood x = (dq, dq'/omega) of the motion obeys
 *
 *     dx/dphi = A(phi) x,     phi = omega (t - t_0),     A = [0 1; -M^-1 (C - W dp/du W^T)/omega^2  -M^-1 (B - W dp/dv
 * W^T)/omega].
 *
 * With x = sum_k x_k(phi) exp(i k phi) the x_k obey equations of constant coefficients, those of Hill's matrix H:
 *
 *     dx_k/dphi = -i k x_k + sum_l A_{k-l} x_l,     |k| <= N,
 *
 * and a start in x_0 alone leads to the monodromy matrix, the sum over k of [exp(2 pi H)]_{k0}.  None of the 2n (2N +
 * 1) eigenvalues needs to be chosen from the others.  N grows until the outermost x_k are below 1e-11.
 *
 * @param derivatives of the forces at the motion, HarmonicBalance::derivatives()
 * @throws std::invalid_argument if forces depend on u'', or M is singular
 * Source: Bayer, Leine, Nonlinear Dynamics 111 (2023), 8439-8466; Hill, Acta Mathematica 8 (1886).
 */
HillMultipliers hill_multipliers(const PeriodicProblem &problem, double omega, int harmonics,
                                 const std::vector<HarmonicForces::Derivative> &derivatives);

enum class FloquetWay
{
  hill,    ///< eigenvectors of a matrix of 2n (2H + 1) rows
  shooting ///< one period integrated with its tangents
};

/// The cheaper way.  Hill's matrix costs some 25 [2n (2H + 1)]^3 operations, tangents some 10^3 ... 10^4 steps of 2n
/// columns: Hill if its matrix has at most 300 rows, about 0.1 s, and without integration.
FloquetWay floquet_way(const PeriodicProblem &problem, int harmonics);

} // namespace gestell::coupling

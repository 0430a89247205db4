#pragma once

#include <Eigen/Core>

#include <complex>
#include <optional>
#include <vector>

namespace gestell::coupling
{

/**
 * Motions exp(s t) of a linear machine that grow, Re s > 0:
 *
 *     (s^2 M + s B + C) q = G^T mu,     G q = 0.
 *
 * With symmetric M, C and no negative eigenvalue of M, C and (B + B^T)/2 there are none, which three Cholesky factors
 * tell.  Else s = sigma (1 + 1/theta) from the eigenvalues theta of
 *
 *     -[ Z^-1 (sigma B + sigma^2 M)       Z^-1 sigma^2 M ]
 *      [ Z^-1 (sigma B + sigma^2 M) - 1   Z^-1 sigma^2 M ],     Z = C + sigma B + sigma^2 M,
 *
 * which includes coordinates without mass (theta = 0).  Motions at rest, and growth within rounding, |s| < 1e-6
 * sigma or Re s < 1e-7 |s|, are omitted; sigma is in the range of the natural frequencies.
 *
 * Source: docs/theory/frequency_response.md, An unstable operating point.
 * @param M, B, C  [n x n], any of them may be unsymmetric
 * @param G  [n_e x n]
 * @return [1/s] of each conjugate pair the one with imaginary part >= 0, fastest growth first; nothing where more than
 * 400 free coordinates need eigenvalues, or these are not found
 */
std::optional<std::vector<std::complex<double>>> unstable_modes(const Eigen::MatrixXd &M, const Eigen::MatrixXd &B,
                                                                const Eigen::MatrixXd &C, const Eigen::MatrixXd &G);

} // namespace gestell::coupling

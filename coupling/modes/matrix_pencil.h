#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace gestell::coupling
{

/// A damped oscillation Re(A exp(s t)) in several signals: |A| is its amplitude at the first sample.
struct DampedOscillation
{
  std::complex<double> s;             ///< [1/s], Im s > 0
  Eigen::VectorXcd     amplitudes;    ///< by signal, at the first sample
  double               strength = 0.; ///< of the amplitudes, each relative to the range of its signal

  double frequency_hz() const;  ///< damped
  double damping_ratio() const; ///< -Re s / |s|
};

struct PencilFit
{
  std::vector<DampedOscillation> oscillations;  ///< the strongest, ascending in frequency
  double                         residual = 0.; ///< relative residual of all poles
};

/**
 * Oscillations that signals have in common, by the matrix pencil:
 *
 *     Y = [Y_1; Y_2; ...],  Y_s[i, j] = y_s(t_{i+j}) [(n - L) x (L + 1)],   Y ~ U S V^T of rank r,
 *     z = eigenvalues of V_first^+ V_last,     s = log(z)/h,
 *
 * with V_first and V_last equal to V without its last and first row, L = n/2.  r is the number of singular values above
 * 1e-4 of the largest, so that weak oscillations and a constant have separate poles and do not disturb the strong ones;
 * the `most` oscillations with the largest amplitudes, relative to the range of each signal, are returned.
 *
 * @param samples  [n x signals] at equal times, n at least 16
 * @param h        [s] between samples
 *
 * Source: T. K. Sarkar, O. Pereira, Using the matrix pencil method to estimate the parameters of a sum of complex
 * exponentials, IEEE Antennas and Propagation Magazine 37 (1995), 48-55.
 * @throws std::invalid_argument for too few samples
 */
PencilFit matrix_pencil(const Eigen::MatrixXd &samples, double h, int most);

} // namespace gestell::coupling

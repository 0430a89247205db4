#pragma once

#include <Eigen/Core>

#include <memory>

namespace gestell::coupling
{

/**
 * Between N equally spaced samples of a real function of period 1 and its Fourier coefficients
 *
 *     x(k/N) = sum_{h = -N/2}^{N/2} c_h exp(2 pi i h k/N),     c_{-h} = conj(c_h),
 *
 * by a fast transform.  Coefficients are exact where no harmonic of x exceeds N/2.
 */
class FourierTransform
{
public:
  /// @param samples N, a multiple of 4; fast where it has small factors
  explicit FourierTransform(int samples);
  ~FourierTransform();
  FourierTransform(FourierTransform &&) noexcept;

  int samples() const { return samples_; }

  /// c_0 ... c_{N/2} [N/2 + 1] of samples [N].
  void coefficients(const double *samples, Eigen::VectorXcd &c) const;
  /// The samples [N] of c_0 ... c_k, k < N/2; all other coefficients are zero.
  void values(const Eigen::VectorXcd &c, double *samples) const;

private:
  struct Library;

  int                      samples_;
  std::unique_ptr<Library> library_;
};

/// The least power of two not below n.
int power_of_two(int n);

} // namespace gestell::coupling

#include "coupling/periodic/harmonic/fourier_transform.h"

#include <unsupported/Eigen/FFT>

#include <complex>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

struct FourierTransform::Library
{
  Eigen::FFT<double> fft{Eigen::FFT<double>::impl_type(), Eigen::FFT<double>::HalfSpectrum};
  Eigen::VectorXcd   half;
};

FourierTransform::FourierTransform(int samples) : samples_(samples), library_(std::make_unique<Library>())
{
  if (samples < 4 || samples % 4 != 0)
    throw std::invalid_argument("FourierTransform: " + std::to_string(samples) +
                                " samples; their number must be a multiple of 4");
  library_->half.setZero(samples / 2 + 1);
}

FourierTransform::~FourierTransform()                            = default;
FourierTransform::FourierTransform(FourierTransform &&) noexcept = default;

void FourierTransform::coefficients(const double *samples, Eigen::VectorXcd &c) const
{
  c.resize(samples_ / 2 + 1);
  library_->fft.fwd(c.data(), samples, samples_);
  c /= double(samples_);
}

/// The library divides by N.
void FourierTransform::values(const Eigen::VectorXcd &c, double *samples) const
{
  library_->half.setZero();
  library_->half.head(c.size()) = double(samples_) * c;
  library_->fft.inv(samples, library_->half.data(), samples_);
}

int power_of_two(int n)
{
  int power = 1;
  while (power < n)
    power *= 2;
  return power;
}

} // namespace gestell::coupling

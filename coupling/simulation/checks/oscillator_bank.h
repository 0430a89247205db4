#pragma once

#include <Eigen/Core>

namespace gestell::coupling
{

class StateArchive;

/**
 * Parallel oscillators  x'' + 2 zeta omega x' + omega^2 x = omega^2 u  for inputs u that are linear between instants:
 * each step is exact.  At rest x = u.
 */
class OscillatorBank
{
public:
  OscillatorBank() = default;
  /// @param omega, zeta  [n] rad/s; 0 <= zeta < 1
  OscillatorBank(const Eigen::ArrayXd &omega, const Eigen::ArrayXd &zeta);

  void begin(const Eigen::ArrayXd &u);             ///< static state for the constant input u
  void advance(double h, const Eigen::ArrayXd &u); ///< by h [s]; u is the input at the end
  void jump(const Eigen::ArrayXd &u);              ///< inputs jump to u at this instant

  const Eigen::ArrayXd &x() const { return x_; }

  void exchange(StateArchive &archive);

private:
  void prepare(double h);

  Eigen::ArrayXd omega_, zeta_;
  Eigen::ArrayXd x_, rate_, u_; ///< x' / omega
  double         h_ = 0.;
  Eigen::ArrayXd xx_, xr_, rr_; ///< exp(A h) = [xx, xr; -xr, rr]
};

} // namespace gestell::coupling

#include "coupling/simulation/checks/oscillator_bank.h"
#include "coupling/integration/system/state_archive.h"

#include <cmath>

namespace gestell::coupling
{

using Eigen::ArrayXd;

OscillatorBank::OscillatorBank(const ArrayXd &omega, const ArrayXd &zeta) : omega_(omega), zeta_(zeta) {}

void OscillatorBank::begin(const ArrayXd &u)
{
  x_    = u;
  rate_ = ArrayXd::Zero(u.size());
  u_    = u;
}

void OscillatorBank::prepare(double h)
{
  const ArrayXd s = (1. - zeta_.square()).sqrt(), theta = h * omega_, decay = (-zeta_ * theta).exp();
  const ArrayXd c = decay * (s * theta).cos(), d = decay * (s * theta).sin() / s;

  xx_ = c + zeta_ * d;
  xr_ = d;
  rr_ = c - zeta_ * d;
  h_  = h;
}

/// The ramp's own solution is x = u - late, x' = u'.
void OscillatorBank::advance(double h, const ArrayXd &u)
{
  constexpr double same_step = 1e-9; // differences of times are rounding
  if (std::abs(h - h_) > same_step * h)
    prepare(h);
  for (Eigen::Index k = 0; k < u.size(); ++k) // one pass: this goes along with every step of a run
  {
    const double ramp = (u[k] - u_[k]) / (h * omega_[k]), late = 2. * zeta_[k] * ramp;
    const double x = x_[k] - u_[k] + late, r = rate_[k] - ramp;

    x_[k]    = xx_[k] * x + xr_[k] * r + u[k] - late;
    rate_[k] = rr_[k] * r - xr_[k] * x + ramp;
  }
  u_ = u;
}

void OscillatorBank::jump(const ArrayXd &u)
{
  u_ = u;
}

void OscillatorBank::exchange(StateArchive &archive)
{
  archive(x_, rate_, u_, h_, xx_, xr_, rr_);
}

} // namespace gestell::coupling

#pragma once

#include "coupling/integration/system/excitation.h"

#include <algorithm>

namespace gestell::coupling
{

/// Highest frequency [rad/s] among harmonic loads; 0 if there are none.
inline double fastest_load(const Excitation &loads)
{
  double omega = 0.;
  for (const Excitation::Harmonic &harmonic : loads.harmonics())
    omega = std::max(omega, harmonic.omega);
  return omega;
}

} // namespace gestell::coupling

#include "coupling/stability_guard.h"

#include "coupling/integration/bdf_stability.h"

#include <sstream>

namespace gestell::coupling
{

std::vector<ModeAccuracy> mode_accuracy(const Machine &machine, const InitialState &, const MethodOptions &options)
{
  if (options.tolerance > 0. || options.method != Method::bdf)
    return {};
  std::vector<ModeAccuracy> result;
  int                       number = 0;
  for (const SpectrumLine &mode : machine.spectrum())
  {
    ++number;
    if (mode.omega == 0.)
      continue;
    const double rho = bdf_spectral_radius(options.order, mode, options.step);
    result.push_back({ModeOrigin::base, number, mode, mode.omega * options.step, rho, 0., 0., rho > 1. + 1e-9});
  }
  return result;
}

void check_stability(const Machine &machine, const InitialState &initial, const MethodOptions &options)
{
  const ModeAccuracy *worst = nullptr;
  const auto          modes = mode_accuracy(machine, initial, options);
  for (const ModeAccuracy &mode : modes)
    if (mode.unstable && (!worst || mode.spectral_radius > worst->spectral_radius))
      worst = &mode;
  if (!worst)
    return;
  std::ostringstream message;
  message << method_name(options) << " is unstable for the mode at " << worst->mode.omega / 6.283185307179586
          << " Hz with damping ratio " << worst->mode.zeta << ": with run.step = " << options.step
          << " s it grows by the factor " << worst->spectral_radius
          << " in every step; bdf of order 2 is stable for every mode";
  throw std::invalid_argument(message.str());
}

std::vector<std::string> stability_warnings(const Machine &, const InitialState &, const MethodOptions &)
{
  return {};
}

} // namespace gestell::coupling

#include "coupling/simulation/run_method.h"

#include "coupling/integration/integration_methods.h"
#include "coupling/integration/system/fastest_load.h"

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

MethodOptions with_largest_step(const Machine &machine, const RunOptions &options)
{
  MethodOptions method = options.method;
  if (!controlled(method) || method.step > 0.)
    return method;
  method.step        = (options.end - options.begin) / 50.;
  const double omega = fastest_load(machine.linear().excitation());
  if (omega > 0.)
    method.step = std::min(method.step, 0.25 * M_PI / omega);
  return method;
}

Sampling sampling_of(const Machine &machine, const MethodOptions &method)
{
  constexpr double samples_of_period = 32.; // extremes to (pi / 32)^2 / 2 = 0.5 %, before parabolas
  Sampling         sampling;
  sampling.inside = controlled(method);
  if (!method_of(method).carries_base())
    return sampling;
  for (const SpectrumLine &mode : machine.linear().spectrum())
    if (mode.omega > 0.)
      sampling.shortest = std::min(sampling.shortest, 2. * M_PI / (samples_of_period * mode.omega));
  // Up to 0.8 rad a step resolves all modes as well as a step of an implicit method.
  sampling.inside = sampling.inside || method.step > 4. * sampling.shortest;
  return sampling;
}

} // namespace gestell::coupling

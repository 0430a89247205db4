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

} // namespace gestell::coupling

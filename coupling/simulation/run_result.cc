#include "coupling/simulation/run_result.h"

namespace gestell::coupling
{

double output_step(const RunOptions &options)
{
  if (options.output_step > 0.)
    return options.output_step;
  return controlled(options.method) ? (options.end - options.begin) / 2000. : options.method.step;
}

} // namespace gestell::coupling

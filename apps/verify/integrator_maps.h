#pragma once

#include "apps/verify/data_table.h"

namespace gestell::apps
{

/**
 * What a method makes of the oscillator x'' + 2 zeta omega x' + omega^2 x = 0, for every row of `expected` by its
 * columns method, zeta, omega_h, start.
 *
 * @param name  "spectral radius", "period and damping", "unstable intervals" (from the column `zeta`), "overshoot"
 * @throws std::invalid_argument for another name, or a row of a method that is not among `methods`
 */
DataTable integrator_map(const std::string &name, const DataTable &expected,
                         const std::map<std::string, coupling::MethodOptions> &methods);

} // namespace gestell::apps

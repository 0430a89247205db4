#pragma once

#include "apps/verify/data_table.h"

namespace gestell::apps
{

/**
 * What a method makes of the oscillator x'' + 2 zeta omega x' + omega^2 x = 0, for every row of `expected` by its
 * columns method, zeta, omega_h, start; rows of methods that are not among `methods` have empty cells.
 *
 * @param name  "spectral radius", "period and damping", "unstable intervals" (from the column `zeta`), "overshoot"
 * @throws std::invalid_argument for another name
 */
DataTable integrator_map(const std::string &name, const DataTable &expected,
                         const std::map<std::string, coupling::MethodOptions> &methods);

} // namespace gestell::apps

#pragma once

#include "coupling/integration/integration_method.h"

namespace gestell::coupling
{

/// Backward differences of order 1 to 6, (5.5.2/6); with a tolerance of controlled order and step.
const IntegrationMethod &bdf_method();

/// Damping ratio from which on no mode grows at any step: 0, 0, 0.0692, 0.286, 0.618, 0.952 for orders 1 to 6.
double sufficient_damping(int bdf_order);

} // namespace gestell::coupling

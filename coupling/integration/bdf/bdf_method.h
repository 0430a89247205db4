#pragma once

#include "coupling/integration/integration_method.h"

namespace gestell::coupling
{

/// Backward differences of order 1 to 6, (5.5.2/6); with a tolerance, of variable order and step.
const IntegrationMethod &bdf_method();

} // namespace gestell::coupling

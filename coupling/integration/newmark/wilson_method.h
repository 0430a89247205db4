#pragma once

#include "coupling/integration/integration_method.h"

namespace gestell::coupling
{

/// Wilson's theta (Wilson, Farhoomand and Bathe 1973).
const IntegrationMethod &wilson_method();

} // namespace gestell::coupling

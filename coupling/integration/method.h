#pragma once

#include "coupling/integration/method_options.h"
#include "coupling/integration/system/time_integrator.h"

#include <memory>

namespace gestell::coupling
{

/// @throws std::invalid_argument as check_method(), and if the method cannot treat the system, with the reason
std::unique_ptr<TimeIntegrator> make_integrator(const SecondOrderSystem &system, const MethodOptions &options);

} // namespace gestell::coupling

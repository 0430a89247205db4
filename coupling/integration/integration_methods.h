#pragma once

#include "coupling/integration/integration_method.h"

#include <memory>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// All integration methods, in the order of the help.
const std::vector<const IntegrationMethod *> &integration_methods();

/// @throws std::invalid_argument for an unknown name
const IntegrationMethod &integration_method(const std::string &name);
const IntegrationMethod &method_of(const MethodOptions &options);

/// "BDF 2", "generalised alpha 0.8", "exact, collocation 6"
std::string method_name(const MethodOptions &options);

/// @throws std::invalid_argument with the parameter, its value and the allowed range
void check_method(const MethodOptions &options);

/// @throws std::invalid_argument as check_method() does, and if the method cannot treat the system, with the reason
std::unique_ptr<TimeIntegrator> make_integrator(const SecondOrderSystem &system, const MethodOptions &options);

} // namespace gestell::coupling

#pragma once

#include "apps/output/values/fmu_description.h"

#include <string>

namespace gestell::apps
{

/// modelDescription.xml of FMI 2.0 for co-simulation.
std::string model_description(const FmuDescription &fmu);

} // namespace gestell::apps

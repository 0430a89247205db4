#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// The section of the report on orders of a rotor's speed; adds its pictures.  "" without such a result.
std::string order_section(const Result &result, Pictures &pictures);

} // namespace gestell::apps

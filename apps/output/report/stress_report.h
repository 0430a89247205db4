#pragma once

#include "apps/output/text/svg.h"
#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Stresses for the page: table of the largest and a picture of each instant, which joins `pictures`; "" if
/// there are none.
std::string stress_section(const Result &result, Pictures &pictures);

} // namespace gestell::apps

#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// Stresses for the page: table of the largest and, on a page with a view, a picture of each instant; "" if there are
/// none.
std::string stress_section(const Result &result, bool has_view);

} // namespace gestell::apps

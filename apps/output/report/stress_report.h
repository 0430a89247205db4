#pragma once

#include "apps/output/report/report.h"
#include "apps/output/result.h"

#include <string>

namespace gestell::apps
{

/// Stresses for the page: table of the largest and a picture of each instant, which joins the report's charts; "" if
/// there are none.
std::string stress_section(const Result &result, Report &report);

} // namespace gestell::apps

#pragma once

#include "apps/analysis/comparison/mode_comparison.h"
#include "apps/analysis/comparison/run_comparison.h"
#include "apps/output/report/section.h"

namespace gestell::apps
{

Section compared_run_section(const Result &result, const ComparedRun &other);
Section compared_modes_section(const Result &result, const ComparedShapes &shapes);

} // namespace gestell::apps

#pragma once

#include "apps/analysis/comparison/mode_comparison.h"
#include "apps/analysis/comparison/run_comparison.h"
#include "apps/output/report/section.h"

namespace gestell::apps
{

std::vector<Section> sections_of(const Result &result, const ComparedRun &other);
std::vector<Section> sections_of(const Result &result, const ComparedShapes &shapes);

} // namespace gestell::apps

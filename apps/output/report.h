#pragma once

#include "apps/output/result.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// The report and its pictures, each (file name without ending, SVG).
struct Report
{
  std::string html;
  std::vector<std::pair<std::string, std::string>> charts;
};

/// One self-contained page: warnings, what was computed, the answer, histories, events, energy, modes, numerics.
Report make_report(const Result &result);

} // namespace gestell::apps

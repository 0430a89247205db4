#pragma once

#include "apps/study/values/study_table.h"

#include <string>

namespace gestell::apps
{

constexpr int most_scatter_columns = 8; ///< of 92 pixels each in a page

/// Every variable and output against every other, the runs as dots, those of `front` in the second colour; above the
/// diagonal coefficients of correlation.  At most eight columns: all outputs first, then variables.  SVG.
std::string scatter_matrix(const StudyTable &usable, const std::vector<int> &front = {});

} // namespace gestell::apps

#pragma once

#include "apps/output/text/csv.h"
#include "apps/output/values/size_result.h"

namespace gestell::apps
{

/// size.csv: a row for each model tried.
CsvTable size_csv(const SizeResult &size);

/// size_all.csv: a row for each model of an exhaustive search; empty without such a search.
CsvTable size_all_csv(const SizeResult &size);

/// The cheapest of all models tried whose difference to the finer model is within the tolerance; null if there is none.
const SizeRung *cheapest_of(const SizeResult &size);

/// For a terminal: text of one model; size_text(): of all models, with the conclusions.
std::string rung_text(const SizeRung &rung);
std::string forecast_text(const SizeForecast &forecast);
std::string size_text(const SizeResult &size);

} // namespace gestell::apps

#pragma once

#include "apps/output/text/csv.h"
#include "apps/output/values/size_result.h"

namespace gestell::apps
{

/// size.csv: a row for each model that was tried.
CsvTable size_csv(const SizeResult &size);

/// size_all.csv: a row for each model of an exhaustive search; empty without one.
CsvTable size_all_csv(const SizeResult &size);

/// Of all models tried the cheapest within the tolerance against the finer one; null: there is none.
const SizeRung *cheapest_of(const SizeResult &size);

/// For a terminal: one model, and all of them with what follows.
std::string rung_text(const SizeRung &rung);
std::string forecast_text(const SizeForecast &forecast);
std::string size_text(const SizeResult &size);

} // namespace gestell::apps

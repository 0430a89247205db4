#pragma once

#include "apps/output/text/json.h"
#include "apps/output/values/error_budget.h"

namespace gestell::apps
{

/// `value`, `unit`, `mesh`, `reduction`, `time`, `total` of an output.
Json entry_json(const BudgetEntry &entry);

/// Of summary.json: by output `value`, `mesh`, `reduction`, `time`, `total` (absolute errors; null: not known), `unit`,
/// `bracket`, `reasons`.
Json budget_json(const ErrorBudget &budget);

/// `budget_cpu_s`: of the run and of what tells each part.
Json budget_cost_json(const ErrorBudget &budget);

/// For a terminal: a line for each output.
std::string budget_text(const ErrorBudget &budget);

} // namespace gestell::apps

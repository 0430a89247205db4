#pragma once

#include "apps/analysis/analysis.h"
#include "apps/output/values/error_budget.h"

namespace gestell::apps
{

/// Errors of outputs for report, summary and terminal, as listed by `run --budget` and `size`.
std::shared_ptr<const Answer> budget_answer(ErrorBudget budget);

} // namespace gestell::apps

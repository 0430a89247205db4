#pragma once

#include "apps/output/values/error_budget.h"

namespace gestell::apps
{

/// For a terminal: a line for each output.
std::string budget_text(const ErrorBudget &budget);

} // namespace gestell::apps

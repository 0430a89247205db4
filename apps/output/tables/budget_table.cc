#include "apps/output/tables/budget_table.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace gestell::apps
{

namespace
{

std::string cell(const std::optional<double> &error)
{
  return error ? short_text(*error, 2) : "-";
}

} // namespace

std::string budget_text(const ErrorBudget &budget)
{
  std::ostringstream text;
  std::size_t        width = 6;
  for (const BudgetEntry &entry : budget.entries)
    width = std::max(width, entry.output.size());
  const int first = int(width) + 2;
  text << "error budget\n"
       << std::left << std::setw(first) << "output" << std::right << std::setw(14) << "value" << std::setw(11) << "mesh"
       << std::setw(11) << "reduction" << std::setw(11) << "time" << std::setw(11) << "total" << '\n';
  for (const BudgetEntry &entry : budget.entries)
  {
    text << std::left << std::setw(first) << entry.output << std::right << std::setw(14) << short_text(entry.value, 7)
         << std::setw(11) << cell(entry.mesh.error) << std::setw(11) << cell(entry.reduction.error) << std::setw(11)
         << cell(entry.time.error) << std::setw(11) << cell(entry.total) << "  " << entry.unit;
    if (!entry.total && entry.bracket)
      text << "  between " << short_text(entry.bracket->first, 5) << " and " << short_text(entry.bracket->second, 5);
    text << '\n';
  }
  for (const BudgetEntry &entry : budget.entries)
    for (const auto &[name, part] :
         {std::pair("mesh", &entry.mesh), std::pair("reduction", &entry.reduction), std::pair("time", &entry.time)})
      if (!part->error)
        text << "  " << entry.output << ", " << name << ": " << part->reason << '\n';
  return text.str();
}

} // namespace gestell::apps

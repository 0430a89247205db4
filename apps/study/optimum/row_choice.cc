#include "apps/study/optimum/row_choice.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr double kept_to = 1e-9; ///< of the size of a limit

bool keeps(const StudyTable &table, const RowChoiceTask &task, int row)
{
  const Eigen::VectorXd values = table.values.row(row).transpose();
  const bool            known  = std::all_of(task.goals.begin(), task.goals.end(),
                                             [&](const Goal &goal) { return std::isfinite(values[goal.output]); });
  return table.runs[std::size_t(row)].status == RunStatus::done && known &&
         violation_of(task.limits, values) <= kept_to;
}

/// Those of a family on both sides of the best one, up to the first that breaks a limit.
std::vector<int> window_about(const std::vector<int> &family, const RowChoice &choice)
{
  const auto kept = [&](int row)
  { return std::find(choice.kept.begin(), choice.kept.end(), row) != choice.kept.end(); };
  const auto best  = std::find(family.begin(), family.end(), choice.best);
  auto       first = best, last = best;
  while (first != family.begin() && kept(*(first - 1)))
    --first;
  while (last + 1 != family.end() && kept(*(last + 1)))
    ++last;
  return {first, last + 1};
}

} // namespace

std::string family_of(const StudyTable &table, const RowChoiceTask &task, int row)
{
  std::string name;
  for (const int variable : task.by)
    name += (name.empty() ? "" : ", ") + table.variables[std::size_t(variable)].text(table.levels(row, variable));
  return name;
}

/// Runs that failed stand last.
bool in_order(double a, double b)
{
  return std::isnan(a) || std::isnan(b) ? !std::isnan(a) && std::isnan(b) : a < b;
}

std::vector<std::vector<int>> families_of(const StudyTable &table, const RowChoiceTask &task)
{
  std::vector<std::string>      names;
  std::vector<std::vector<int>> families;
  for (int row = 0; row < table.n_runs(); ++row)
  {
    const std::string name  = family_of(table, task, row);
    const auto        found = std::find(names.begin(), names.end(), name);
    const std::size_t at    = std::size_t(found - names.begin());
    if (found == names.end())
    {
      names.push_back(name);
      families.emplace_back();
    }
    families[at].push_back(row);
  }
  if (task.over >= 0)
    for (std::vector<int> &family : families)
      std::stable_sort(family.begin(), family.end(),
                       [&](int a, int b) { return in_order(table.values(a, task.over), table.values(b, task.over)); });
  return families;
}

RowChoice choose_row(const StudyTable &table, const RowChoiceTask &task)
{
  RowChoice choice{task};
  double    least = std::numeric_limits<double>::infinity();
  for (int row = 0; row < table.n_runs(); ++row)
    if (keeps(table, task, row))
    {
      choice.kept.push_back(row);
      const double objective = objective_of(task.goals, table.values.row(row).transpose());
      if (objective < least)
      {
        least       = objective;
        choice.best = row;
      }
    }
  if (choice.best >= 0 && task.over >= 0)
    for (const std::vector<int> &family : families_of(table, task))
      if (std::find(family.begin(), family.end(), choice.best) != family.end())
        choice.window = window_about(family, choice);
  return choice;
}

} // namespace gestell::apps

#include "apps/study/optimum/row_choice.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

bool keeps(const StudyTable &table, const RowChoiceTask &task, int row)
{
  const Eigen::VectorXd values  = table.values.row(row).transpose();
  const bool            known   = std::all_of(task.goals.begin(), task.goals.end(),
                                              [&](const Goal &goal) { return std::isfinite(values[goal.output]); });
  constexpr double      kept_to = 1e-9; // of the size of a limit: ten written digits
  return table.runs[std::size_t(row)].status == RunStatus::done && known &&
         violation_of(task.limits, values) <= kept_to;
}

/// Those of a family on both sides of its best one, up to the first that breaks a limit.
std::vector<int> window_about(int best_row, const std::vector<int> &family, const RowChoice &choice)
{
  const auto kept = [&](int row)
  { return std::find(choice.kept.begin(), choice.kept.end(), row) != choice.kept.end(); };
  const auto best  = std::find(family.begin(), family.end(), best_row);
  auto       first = best, last = best;
  while (first != family.begin() && kept(*(first - 1)))
    --first;
  while (last + 1 != family.end() && kept(*(last + 1)))
    ++last;
  return {first, last + 1};
}

/// The row of least objective among those that keep all limits; -1: none does.
int best_of(const StudyTable &table, const RowChoice &choice, const std::vector<int> &rows)
{
  int    best  = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const int row : rows)
    if (std::find(choice.kept.begin(), choice.kept.end(), row) != choice.kept.end())
      if (const double objective = objective_of(choice.task.goals, table.values.row(row).transpose());
          objective < least)
      {
        least = objective;
        best  = row;
      }
  return best;
}

/// Rows as good as the best one.
std::vector<int> ties_of(const StudyTable &table, const RowChoice &choice)
{
  std::vector<int> ties;
  const auto objective = [&](int row) { return objective_of(choice.task.goals, table.values.row(row).transpose()); };
  constexpr double tied_to = 1e-9; // of the objective: ten written digits
  for (const int row : choice.kept)
    if (row != choice.best && objective(row) - objective(choice.best) <= tied_to * std::abs(objective(choice.best)))
      ties.push_back(row);
  return ties;
}

/// A word as it names a family: a truth by its variable.
std::string family_word(const StudyVariable &variable, double level)
{
  const std::string word = variable.text(level);
  return word == "true" ? variable.name : word == "false" ? "not " + variable.name : word;
}

} // namespace

std::string family_of(const StudyTable &table, const RowChoiceTask &task, int row)
{
  std::string name;
  for (const int variable : task.by)
    name +=
        (name.empty() ? "" : ", ") + family_word(table.variables[std::size_t(variable)], table.levels(row, variable));
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
  for (int row = 0; row < table.n_runs(); ++row)
    if (keeps(table, task, row))
      choice.kept.push_back(row);
  choice.best = best_of(table, choice, choice.kept);
  if (choice.best >= 0)
    choice.ties = ties_of(table, choice);
  for (const std::vector<int> &rows : families_of(table, task))
  {
    FamilyChoice family{rows, best_of(table, choice, rows)};
    if (family.best >= 0 && task.over >= 0)
      family.window = window_about(family.best, rows, choice);
    if (family.best >= 0 && std::find(rows.begin(), rows.end(), choice.best) != rows.end())
      choice.window = family.window;
    choice.families.push_back(family);
  }
  return choice;
}

} // namespace gestell::apps

#pragma once

#include "apps/study/optimum/optimum_task.h"
#include "apps/study/values/study_table.h"

namespace gestell::apps
{

/// Which of the runs is to be chosen, and how they are shown.
struct RowChoiceTask
{
  std::vector<Goal>  goals{};
  std::vector<Limit> limits{};
  int                over = -1; ///< output over which the others are drawn; -1: none
  std::vector<int>   by{};      ///< variables whose words part the runs into families
};

/// The best of a family.
struct FamilyChoice
{
  std::vector<int> rows{};
  int              best = -1; ///< row; -1: none keeps all limits
  std::vector<int> window{};  ///< rows next to it that keep them, too, by `over`
};

/// The best of runs that were made: the one of least objective among those that keep all limits.
struct RowChoice
{
  RowChoiceTask             task{};
  int                       best = -1;  ///< row; -1: no run keeps all limits
  std::vector<int>          ties{};     ///< other rows that keep them with the same objective, to rounding
  std::vector<int>          kept{};     ///< rows that keep them
  std::vector<int>          window{};   ///< rows of the best one's family next to it that keep them, too, by `over`
  std::vector<FamilyChoice> families{}; ///< in the order of their first rows
};

/// Of rows with a finite value of every goal and limit.
RowChoice choose_row(const StudyTable &table, const RowChoiceTask &task);

/// The words of a row's family, "linear, not tyres_pull" where that is a truth; empty without `by`.
std::string family_of(const StudyTable &table, const RowChoiceTask &task, int row);

/// Rows of each family, by ascending `over`; families in the order of their first rows.
std::vector<std::vector<int>> families_of(const StudyTable &table, const RowChoiceTask &task);

} // namespace gestell::apps

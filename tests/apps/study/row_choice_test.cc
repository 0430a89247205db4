#include "apps/study/optimum/row_choice.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace apps;

/// Two families of braking: force and safety over the braking time.
StudyTable table_of(const std::vector<std::array<double, 4>> &rows)
{
  StudyTable table;
  table.variables          = {{"profile", "brake.family"}};
  table.variables[0].words = {"linear", "cosine"};
  table.outputs            = {{"time", "s"}, {"force", "N"}, {"safety", ""}};
  table.levels.resize(Eigen::Index(rows.size()), 1);
  table.values.resize(Eigen::Index(rows.size()), 3);
  table.runs.resize(rows.size(), {RunStatus::done});
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    table.levels(Eigen::Index(i), 0) = rows[i][0];
    for (int j = 0; j < 3; ++j)
      table.values(Eigen::Index(i), j) = rows[i][std::size_t(j) + 1];
  }
  return table;
}

RowChoiceTask largest_force()
{
  RowChoiceTask task;
  task.goals  = {{1, Sense::maximise, 1., 1.}};
  task.limits = {{2, 1.25}};
  task.over   = 0;
  task.by     = {0};
  return task;
}

TEST(RowChoice, IsTheBestRunThatKeepsAllLimits)
{
  const StudyTable table  = table_of({{0, 1, 10, 1.4}, {0, 2, 30, 1.3}, {0, 3, 90, 1.2}, {1, 1, 20, 1.5}});
  const RowChoice  choice = choose_row(table, largest_force());
  EXPECT_EQ(choice.best, 1);
  EXPECT_EQ(choice.kept, (std::vector<int>{0, 1, 3}));
}

TEST(RowChoice, HasTheBestOfEveryFamilyWithItsOwnWindow)
{
  StudyTable table =
      table_of({{0, 1, 10, 1.4}, {0, 2, 30, 1.3}, {1, 1, 20, 1.5}, {1, 2, 15, 1.4}, {1, 3, 50, 1.1}, {2, 1, 1, 1.}});
  table.variables[0].words = {"true", "false", "cosine"};
  const RowChoice choice   = choose_row(table, largest_force());
  ASSERT_EQ(choice.families.size(), 3u);
  EXPECT_EQ(choice.families[1].best, 2);
  EXPECT_EQ(choice.families[1].window, (std::vector<int>{2, 3}));
  EXPECT_EQ(choice.families[2].best, -1);
  EXPECT_EQ(family_of(table, choice.task, 0), "profile");
  EXPECT_EQ(family_of(table, choice.task, 2), "not profile");
}

TEST(RowChoice, HasTheWindowOfItsFamilyUpToTheFirstRunThatBreaksALimit)
{
  const StudyTable table =
      table_of({{0, 4, 9, 1.3}, {0, 2, 30, 1.3}, {1, 2.5, 0, 1.3}, {0, 3, 5, 1.2}, {0, 1, 10, 1.4}});
  const RowChoice choice = choose_row(table, largest_force());
  EXPECT_EQ(choice.window, (std::vector<int>{4, 1})); // the run at 4 s lies behind one that breaks the limit
  EXPECT_EQ(family_of(table, choice.task, choice.best), "linear");
}

/// Where a failed run would stand is not known; the others keep their order.
TEST(RowChoice, HasItsWindowWhateverRunFailed)
{
  const double nan     = std::numeric_limits<double>::quiet_NaN();
  StudyTable   table   = table_of({{0, 1, 10, 1.4}, {0, 3, 5, 1.3}, {0, nan, nan, nan}, {0, 2, 30, 1.3}});
  table.runs[2].status = RunStatus::failed;
  EXPECT_EQ(choose_row(table, largest_force()).window, (std::vector<int>{0, 3, 1}));
}

TEST(RowChoice, IsNoneWhereEveryRunBreaksALimitOrHasFailed)
{
  StudyTable table     = table_of({{0, 1, 10, 1.2}, {0, 2, 30, 1.3}});
  table.runs[1].status = RunStatus::failed;
  EXPECT_EQ(choose_row(table, largest_force()).best, -1);
}

} // namespace
} // namespace gestell::tests

// Tables of text: cells, and numbers that formulas of columns give.

#include "apps/verify/data_table.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using Cells = std::vector<std::string>;

TEST(DataTable, QuotedCellsHoldCommasAndDoubledQuotes)
{
  const apps::DataTable table = apps::table_of("events", "t,name\n1,\"a \"\"short\"\" stop, at last\"\n2,\"\"\n");
  EXPECT_EQ(table.rows, (std::vector<Cells>{{"1", "a \"short\" stop, at last"}, {"2", ""}}));
}

TEST(DataTable, ALineWithACellTooFewIsRefused)
{
  expect_refusal([] { apps::table_of("events", "t,name\n1\n"); },
                 "events:2: has 1 cells instead of 2, one for each column");
}

TEST(DataTable, AFormulaOfColumnsIsACell)
{
  const apps::DataTable table = apps::table_of("multipliers", "re,im,t,word\n3,4,7,stable\n");
  EXPECT_EQ(table.cell(0, "word"), "stable");
  EXPECT_EQ(table.cell(0, "t"), "7"); // the column, not a tonne
  EXPECT_EQ(table.cell(0, "sqrt(re^2 + im^2)"), "5");
  expect_refusal([&] { table.cell(0, "word + 1"); }, "word");
  expect_refusal([&] { table.cell(0, "g"); }, "no column 'g'"); // no gram either
}

TEST(DataTable, RowsOfAMethodLeftOutAreGone)
{
  const apps::DataTable table = apps::table_of("map", "method,zeta\na,0\nb,0\na,1\n");
  EXPECT_EQ(table.without("method", "a").rows, (std::vector<Cells>{{"b", "0"}}));
  expect_refusal([&] { table.without("methods", "a"); }, "method");
}

} // namespace
} // namespace gestell::tests

#include "apps/output/text/change_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gestell::apps
{
namespace
{

// A pull that grows is larger, whatever its sign.
TEST(ChangeText, IsThatOfTheMagnitude)
{
  EXPECT_EQ(change_text(-100., -110.), "10 % larger");
  EXPECT_EQ(change_text(100., 110.), "10 % larger");
  EXPECT_EQ(change_text(-100., -90.), "10 % smaller");
  EXPECT_EQ(change_text(100., 0.), "100 % smaller");
}

TEST(ChangeText, IsNoPercentageWhereNoneTells)
{
  EXPECT_EQ(change_text(-100., 90.), "of the other sign");
  EXPECT_EQ(change_text(3., 3. * (1. + 1e-12)), "the same");
  EXPECT_EQ(change_text(0., 0.), "the same");
  EXPECT_EQ(change_text(0., 5.), "");
  EXPECT_EQ(change_text(1., std::nan("")), "");
}

} // namespace
} // namespace gestell::apps

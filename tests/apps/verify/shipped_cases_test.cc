// The cases shipped with the program, long ones too: all hold.

#include "tests/support/program.h"

namespace gestell::tests
{
namespace
{

TEST(ShippedCases, AllHold)
{
  const Folder folder("shipped_cases");
  expect_answer(gestell("verify --all -o '" + folder.results().string() + "'"), 0, {"all passed"});
  const std::string page = read(folder.results() / "verification.html");
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  EXPECT_NE(page.find("rod force after the snap-through shock"), std::string::npos);
  EXPECT_NE(page.find("press/doe.csv"), std::string::npos);
}

} // namespace
} // namespace gestell::tests

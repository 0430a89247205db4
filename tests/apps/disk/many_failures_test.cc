// The figures of docs/develop/robustness.md: 200 failed writes and 200 kills.

#include "tests/apps/disk/disk_cases.h"

#include <iostream>

namespace gestell::tests
{
namespace
{

TEST(ManyFailedWrites, AreAllReportedAndLeaveWholeFiles)
{
  const DiskCases cases;
  const int       n = fail_writes(cases, 1 + 200 / int(cases.all().size()));
  std::cout << n << " failed writes\n";
  EXPECT_GE(n, 200);
}

TEST(ManyKills, LeaveNothingHalfWrittenThatIsTakenForGood)
{
  const DiskCases cases;
  int             n = 0;
  for (unsigned seed = 1; n < 200 && seed < 10; ++seed)
    n += kill_often(cases, 1 + 200 / int(cases.all().size()), seed);
  std::cout << n << " kills\n";
  EXPECT_GE(n, 200);
}

} // namespace
} // namespace gestell::tests

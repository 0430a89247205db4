// A process that is killed leaves nothing half written that the next one takes for good.

#include "tests/apps/disk/disk_cases.h"

namespace gestell::tests
{
namespace
{

TEST(KilledProgram, GoesOnOrIsMadeAgainWithTheSameResult)
{
  const DiskCases cases;
  EXPECT_GT(kill_often(cases, 2, 23), 0);
}

} // namespace
} // namespace gestell::tests

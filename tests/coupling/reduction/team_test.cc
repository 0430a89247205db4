// Failures among ranks: none is left waiting.  What they find together: modes, and how many there are.

#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

Answer trial(const std::string &how, int ranks = 2)
{
  return shell("OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout 300 mpirun --oversubscribe "
               "--mca mpi_yield_when_idle 1 -np " +
               std::to_string(ranks) + " '" GESTELL_BINARY_DIR "/bin/team_trial' " + how);
}

TEST(Team, WorksTogether)
{
  const Answer answer = trial("sound");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_TRUE(answer.says("2 ranks took part\nthen 2 ranks took part")) << answer.text;
}

TEST(Team, IsInformedOfAFailureThatAllAgreeOnAndGoesOn)
{
  const Answer answer = trial("agreed");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_TRUE(answer.says("told: the part of this rank is wrong (rank 1 of 2)")) << answer.text;
  EXPECT_TRUE(answer.says("then 2 ranks took part")) << answer.text;
}

TEST(Team, EndsWithAMessageWhereOneRankBreaksDown)
{
  const Answer answer = trial("abrupt");
  EXPECT_EQ(answer.exit_code, 3) << answer.text;
  EXPECT_TRUE(answer.says("gestell: the computation failed on rank 1 of 2: this rank broke down")) << answer.text;
  EXPECT_FALSE(answer.says("took part")) << answer.text;
}

TEST(Team, SolvesAndFindsModesAsOneProcessDoes)
{
  for (const int ranks : {2, 3})
  {
    const Answer answer = trial("compare", ranks);
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    EXPECT_FALSE(answer.says("differs")) << answer.text;
    for (const char *what :
         {"regularity", "solution", "frequencies", "mass of the modes", "shapes", "number", "rest by block-lanczos",
          "mass by block-lanczos", "rest by krylov-schur", "mass by krylov-schur", "rest by lobpcg", "mass by lobpcg",
          "solution with the matrix given away", "refusal of what is not positive",
          "refusal of a factor of one process"})
      EXPECT_TRUE(answer.says("the " + std::string(what) + " agrees")) << what << answer.text;
  }
}

TEST(Team, OfSixteenRanksGivesAShareOfTheFactorToEach)
{
  const Answer answer = trial("shares", 16);
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_TRUE(answer.says("16 ranks took part\nthen 16 ranks took part")) << answer.text;
}

TEST(Team, ReducesAFrameWhoseMatricesItHas)
{
  for (const int ranks : {2, 3})
  {
    const Answer answer = trial("give", ranks);
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    EXPECT_FALSE(answer.says("differs")) << answer.text;
    EXPECT_TRUE(answer.says("a floating frame by static shapes agrees")) << answer.text;
    EXPECT_TRUE(answer.says("the frame is unconstrained with its interface fixed (C22 is singular): translation"))
        << answer.text;
    EXPECT_TRUE(answer.says("the matrix taken back agrees")) << answer.text;
  }
}

TEST(Team, FindsAllModesThereAreAndRefusesToFindMore)
{
  const Answer answer = trial("exhaust");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  for (const char *count : {"16", "19", "21"})
    EXPECT_TRUE(answer.says(std::string(count) + " of 21 modes found: " + count + ",")) << count << answer.text;
  EXPECT_TRUE(answer.says("Hz gives 21 fixed-interface modes below it, and all of them are found")) << answer.text;
  EXPECT_TRUE(answer.says("lowest modes: 21 of 22 exist, because the mass matrix has no higher rank")) << answer.text;
}

TEST(Team, TakesNoModesWhereNoneIsNeeded)
{
  const Answer answer = trial("none");
  EXPECT_EQ(answer.exit_code, 0) << answer.text;
  EXPECT_TRUE(answer.says("0 modes: reduction: 0 fixed-interface modes")) << answer.text;
}

} // namespace
} // namespace gestell::tests

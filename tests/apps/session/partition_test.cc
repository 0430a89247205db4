// Why coordinates of a reduced frame are in q1, and interfaces that are superfluous.

#include "apps/session/session.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::Partition;
using apps::Session;

/// Five masses in a chain, to be reduced: `a`, `b`, `c`, `d` are interfaces.
std::string chain_reduced(const std::string &reduction)
{
  std::string text =
      "name = \"chain\"\n" + table("frame", {{"mass", "[[1,0,0,0,0],[0,1,0,0,0],[0,0,1,0,0],[0,0,0,1,0],[0,0,0,0,1]]"},
                                             {"stiffness", "[[2e3,-1e3,0,0,0],[-1e3,2e3,-1e3,0,0],[0,-1e3,2e3,-1e3,0],"
                                                           "[0,0,-1e3,2e3,-1e3],[0,0,0,-1e3,1e3]]"}});
  int row = 1;
  for (const std::string name : {"a", "b", "c", "d"})
    text += table("frame.interface." + name, {{"rows", "{ ux = " + std::to_string(row) + " }"},
                                              {"position", "[" + std::to_string(row++) + ", 0, 0]"}});
  return text + reduction;
}

Partition partition_of(const std::string &text)
{
  const test::SceneFolder folder;
  return Session(folder.write("scene.toml", text)).partition();
}

const std::string reduced = table("reduction", {{"method", "craig-bampton"}, {"modes", "1"}});

} // namespace

/// Every kind of reason by its name; what nothing acts on is superfluous, what is read alone is said to be.
TEST(Partition, ReportsWhatActsOnEveryCoordinate)
{
  const Partition partition = partition_of(
      chain_reduced(reduced) +
      element("stop", "stop", {{"from", "frame.a"}, {"direction", "[1, 0, 0]"}, {"gap", "0.1"}, {"stiffness", "10"}}) +
      element("spring", "spring-damper",
              {{"from", "frame.a"}, {"to", "frame.b"}, {"direction", "[1, 0, 0]"}, {"stiffness", "5"}}) +
      element("shaker", "force",
              {{"from", "frame.b"},
               {"direction", "[1, 0, 0]"},
               {"harmonics", "[{ amplitude = '1 N', frequency = '2 Hz' }]"}}) +
      test::quoted("[output.signals]\nx = 'frame.c.ux'\n"));
  ASSERT_EQ(partition.rows.size(), 4u);
  EXPECT_EQ(partition.rows[0].coordinate, "frame.a.ux");
  EXPECT_EQ(partition.rows[0].reasons, (std::vector<std::string>{"linear: spring", "nonlinear: stop"}));
  EXPECT_EQ(partition.rows[1].reasons, (std::vector<std::string>{"excited: shaker", "linear: spring"}));
  EXPECT_EQ(partition.rows[2].reasons, (std::vector<std::string>{"read by: x"}));
  EXPECT_TRUE(partition.rows[3].reasons.empty());
  EXPECT_EQ(partition.only_read, std::vector<std::string>{"c"});
  ASSERT_EQ(partition.superfluous.size(), 1u);
  EXPECT_EQ(partition.superfluous[0].interface, "d");
  EXPECT_EQ(partition.superfluous[0].coordinates, 1);
  EXPECT_EQ(partition.n2, 1);
  EXPECT_EQ(partition.n_modes, 1);
  EXPECT_EQ(partition.n_free, 0);
}

/// Two masses and one without mass between them, floating along x: one coordinate must stay to hold the motion, by
/// rank.
TEST(Partition, KeepsWhatHoldsAFloatingFrame)
{
  const auto floating = [](const std::string &acting)
  {
    return partition_of("name = \"bar\"\n" +
                        table("frame", {{"mass", "[[1,0,0],[0,0,0],[0,0,1]]"},
                                        {"stiffness", "[[1e3,-1e3,0],[-1e3,2e3,-1e3],[0,-1e3,1e3]]"}}) +
                        table("frame.interface.a", {{"rows", "{ ux = 1 }"}, {"position", "[0, 0, 0]"}}) +
                        table("frame.interface.b", {{"rows", "{ ux = 3 }"}, {"position", "[1, 0, 0]"}}) +
                        table("reduction", {{"method", "craig-bampton"}, {"modes", "0"}}) + acting);
  };
  const Partition alone = floating("");
  EXPECT_EQ(alone.n_free, 1);
  EXPECT_EQ(alone.n_held_by_acted, 0);
  EXPECT_EQ(alone.n_massless, 1);
  EXPECT_EQ(alone.rows[0].reasons.size() + alone.rows[1].reasons.size(), 1u);
  ASSERT_EQ(alone.superfluous.size(), 1u);
  const Partition held = floating(
      element("spring", "spring-damper", {{"from", "frame.b"}, {"direction", "[1, 0, 0]"}, {"stiffness", "5"}}));
  EXPECT_EQ(held.n_held_by_acted, 1);
  EXPECT_TRUE(held.rows[0].reasons.empty());
  EXPECT_EQ(held.superfluous.at(0).interface, "a");
}

/// A frame of which every coordinate is kept has none.
TEST(Partition, OfAnUnreducedFrameIsRefused)
{
  expect_refusal([] { partition_of(chain_reduced("")); }, "not reduced");
}

} // namespace gestell::tests

// Several children at a time: what comes back, and the end of all when one fails.

#include "fem/process/side_by_side.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

#include <chrono>
#include <thread>

#include <unistd.h>

namespace gestell::fem
{
namespace
{

using gestell::tests::expect_refusal;
using gestell::tests::refusal;

const ChildTask one_of_several = {"", "scene.toml:3: frame", "start", {}, true};

TEST(SideBySide, EveryResultComesBack)
{
  for (const int at_once : {1, 2, 3, 8})
  {
    std::vector<int> results(5, 0);
    const auto       here = std::this_thread::get_id();
    side_by_side(
        5, at_once,
        [&](const std::string &, double share)
        {
          EXPECT_EQ(std::this_thread::get_id(), here);
          EXPECT_LE(share, 1.);
        },
        [&](int i, const ChildProgress &progress)
        {
          results[i] = in_child<int>(one_of_several, progress,
                                     [&](const ChildProgress &report)
                                     {
                                       report("part", -1.);
                                       return i * i;
                                     });
        });
    EXPECT_EQ(results, (std::vector<int>{0, 1, 4, 9, 16}));
  }
}

TEST(SideBySide, TheFirstFailureEndsTheOthersWithItsWords)
{
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(refusal(
                [&]
                {
                  side_by_side(8, 3, {},
                               [&](int i, const ChildProgress &progress)
                               {
                                 in_child<int>(one_of_several, progress,
                                               [&](const ChildProgress &report)
                                               {
                                                 report("part", -1.);
                                                 if (i == 1)
                                                   throw std::invalid_argument("part 2 of 8 fails");
                                                 ::sleep(60);
                                                 return 0;
                                               });
                               });
                }),
            "part 2 of 8 fails");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(SideBySide, ProgressThatThrowsEndsAll)
{
  expect_refusal<std::runtime_error>(
      []
      {
        side_by_side(
            2, 2, [](const std::string &, double) { throw std::runtime_error("interrupted"); },
            [](int, const ChildProgress &progress)
            {
              in_child<int>(one_of_several, progress,
                            [](const ChildProgress &report)
                            {
                              report("part", -1.);
                              ::sleep(60);
                              return 0;
                            });
            });
      },
      "interrupted");
}

} // namespace
} // namespace gestell::fem

// Belts that are slack or tight at the start.

#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// Pulleys of 60 and 150 mm at a centre distance of 0.5 m: the way around them is 1.675 m.
std::string belt(const Keys &more)
{
  Keys keys{{"from", "one"},          {"to", "two"},           {"axis", "[0, 1, 0]"},
            {"radius_from", "60 mm"}, {"radius_to", "150 mm"}, {"stiffness", "80 N/mm"}};
  keys.insert(keys.end(), more.begin(), more.end());
  return rotor_body("two", "0.04 kg m^2", "[0, 1, 0]", {{"position", "['0.5 m', 0, 0]"}}) +
         element("drive", "belt", keys);
}

const std::string rotor_one = rotor_body("one", "0.01 kg m^2", "[0, 1, 0]", {{"position", "[0, 0, 0]"}});

std::string warnings(const std::string &length)
{
  std::string text;
  for (const std::string &warning : test::scene_of(rotor_one + belt({{"length", length}})).warnings)
    text += warning;
  return text;
}

TEST(BeltAtTheStart, IsReportedIfItIsSlackOrTight)
{
  EXPECT_EQ(warnings("1.67 m"), "");
  EXPECT_THAT(warnings("1.65 m"), ::testing::HasSubstr("stretched by 1.57 % at the start"));
  EXPECT_THAT(warnings("1.68 m"), ::testing::HasSubstr("both strands are slack at the start"));
}

} // namespace
} // namespace gestell::tests

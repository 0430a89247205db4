// A scene told back in words.

#include "apps/scene/build/scene_summary.h"
#include "apps/scene/scene.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

std::string words_of(const std::string &scene)
{
  std::string text;
  for (const std::string &line : apps::scene_summary(apps::read_scene(GESTELL_SOURCE_DIR "/apps/scenes/" + scene)))
    text += line + "\n";
  return text;
}

// A closed chain in the plane, in which one joint closes twice, one in space whose rigid bodies have six equations of
// their own, and a crane: lift and pitch of the chassis, two swings of the load.  A joint that yields holds nothing.
TEST(SceneSummary, CountsTheDegreesOfFreedomOfAMechanism)
{
  EXPECT_NE(words_of("double_four_bar.toml").find("mechanism on a fixed frame: 1 DOF"), std::string::npos);
  EXPECT_NE(words_of("spatial_crank_rocker.toml").find("mechanism on a fixed frame: 1 DOF"), std::string::npos);
  EXPECT_NE(words_of("offset_four_bar.toml").find("mechanism on a fixed frame: 19 DOFs"), std::string::npos);
  EXPECT_NE(words_of("crane_minimal.toml").find("mechanism on a fixed frame: 4 DOFs"), std::string::npos)
      << words_of("crane_minimal.toml");
}

TEST(SceneSummary, NamesWhatThereIs)
{
  const std::string press = words_of("press_minimal.toml");
  for (const char *part :
       {"interfaces 'crown', 'table'", "'slide' (slider guided by frame.crown)", "nonlinear 'motor', 'rod', 'sheet'",
        "2 of the frame, 3 of bodies\n", "bdf to t = 0.45 s in 45001 steps of 1e-05 s"})
    EXPECT_NE(press.find(part), std::string::npos) << part << "\n" << press;
}

} // namespace
} // namespace gestell::tests

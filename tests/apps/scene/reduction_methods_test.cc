#include "apps/scene/scene.h"
#include "coupling/reduction/reductions.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell;
using coupling::Reductions;

std::string reduced_by(const std::string &method, const std::string &lines = "")
{
  return test::small_scene("[run]", "[reduction]\nmethod = \"" + method + "\"\n" + lines + "[run]");
}

apps::ReductionRequest request_of(const std::string &text)
{
  const test::SceneFolder folder;
  return apps::read_scene(folder.write("scene.toml", text)).reduction;
}

TEST(ReductionMethods, OfTheTableAreThoseOfScenes)
{
  for (const auto &entry : Reductions::entries())
  {
    const auto request = request_of(reduced_by(entry.name));
    EXPECT_EQ(request.method, entry.name);
    EXPECT_EQ(request.options.method, request.reduces() ? entry.name : "craig-bampton") << "of the companion";
  }
  EXPECT_NE(test::complaint(reduced_by("gyuan")).find("craig-bampton"), std::string::npos);
}

TEST(ReductionMethods, TakeTheirOwnKeysAndRefuseThoseOfOthers)
{
  const std::map<std::string, std::string> values = {{"tolerance", "0.02"},      {"modes", "1"},
                                                     {"frequency", "20"},        {"inside", "\"fixed-interface\""},
                                                     {"factor", "\"mumps\""},    {"eigensolver", "\"lobpcg\""},
                                                     {"inertia_relief", "true"}, {"damping", "\"diagonal\""}};
  for (const auto &method : Reductions::entries())
  {
    for (const std::string &key : method.keys)
      EXPECT_TRUE(values.count(key)) << key;
    for (const auto &[key, value] : values)
    {
      const std::string text = reduced_by(method.name, key + " = " + value + "\n");
      if (method.name == "modal" && method.takes(key))
        EXPECT_NO_THROW(request_of(text)); // the motor of this machine is what it refuses
      else if (method.takes(key))
        EXPECT_EQ(test::complaint(text), "") << method.name;
      else
      {
        const std::string message = test::complaint(text);
        EXPECT_NE(message.find(key), std::string::npos) << message;
        EXPECT_NE(message.find("method = \"" + method.name + "\""), std::string::npos) << message;
      }
    }
  }
}

TEST(ReductionMethods, InsideFreeInterfaceIsTheMethodOfThatName)
{
  const auto inside = request_of(reduced_by("craig-bampton", "inside = \"free-interface\"\n"));
  EXPECT_EQ(inside.options.method, request_of(reduced_by("free-interface")).options.method);
  EXPECT_TRUE(inside.reduces());
}

} // namespace

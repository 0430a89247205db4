// Machines of linear laws alone, of which no method has a nonlinear measure to solve for: every method on every kind.

#include "apps/session/session.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace gestell::tests
{
namespace
{

using apps::PeriodicRequest;

std::string load(const std::string &harmonics)
{
  return element("load", "force",
                 {{"from", "slide"}, {"to", "ground"}, {"direction", "[1, 0, 0]"}, {"harmonics", harmonics}});
}

const std::string five_hertz = "[{ amplitude = '10 N', frequency = '5 Hz' }]";

std::string spring(const std::string &to)
{
  return element("spring", "spring-damper",
                 {{"from", "slide"}, {"to", to}, {"stiffness", "1000"}, {"damping", "1"}, {"direction", "[1, 0, 0]"}});
}

std::string slide()
{
  return slider_body("slide", "1", "[1, 0, 0]");
}

struct Kind
{
  const char *name;
  std::string scene;
};

std::vector<Kind> kinds()
{
  const std::string signal = test::quoted("[output.signals]\nx = 'slide.displacement'\n");
  return {{"held and pushed", slide() + spring("ground") + load(five_hertz) + signal},
          {"held by a spring without a damper",
           slide() + element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "1000"}}) + load(five_hertz) +
               signal},
          {"held at rest", slide() + spring("ground") + signal},
          {"free and pushed", slide() + load(five_hertz) + signal},
          {"two, held by each other",
           slide() + slider_body("other", "2", "[1, 0, 0]") + spring("other") + load(five_hertz) + signal}};
}

} // namespace

/// What is held and pushed swings by |F / (c - m w^2 + i w b)| with every method (averaging to the second order of
/// small forces); of the others each method finds a motion, tells where the long run led, or fails in words.
TEST(LinearMotions, AreFoundOrRefusedByEveryMethod)
{
  const double w = 10. * M_PI, amplitude = 10. / std::hypot(1000. - w * w, w);
  for (const Kind &kind : kinds())
    for (const std::string method :
         {"shooting", "collocation", "harmonic-balance", "settling", "minimise", "averaging"})
    {
      SCOPED_TRACE(std::string(kind.name) + ", " + method);
      const test::SceneFolder folder;
      PeriodicRequest         request;
      request.method = method;
      request.period = "0.2 s";
      if (method == "minimise")
        request.own["starts"] = 2;
      const bool is_held  = std::string(kind.name).rfind("held", 0) == 0;
      const auto scene    = folder.write("scene.toml", test::quoted(kind.scene));
      const auto answered = [&](const apps::PeriodicResult &result)
      {
        EXPECT_TRUE(!result.entries.empty() || result.long_run || result.failure.size() > 20u);
        if (std::string(kind.name) != "held and pushed")
          return;
        ASSERT_FALSE(result.entries.empty()) << result.failure;
        EXPECT_NEAR(result.entries[0].signals.at(0).max, amplitude, (method == "averaging" ? 1e-2 : 1e-4) * amplitude);
      };
      try
      {
        answered(*apps::Session(scene).periodic(request).periodic);
      }
      catch (const std::invalid_argument &refusal)
      {
        EXPECT_FALSE(is_held && method != "averaging" && method != "minimise") << refusal.what();
        EXPECT_THAT(refusal.what(), testing::HasSubstr(method == "harmonic-balance" ? "harmonic balance" : method));
      }
    }
}

} // namespace gestell::tests

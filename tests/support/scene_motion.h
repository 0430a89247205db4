#pragma once

#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace gestell::tests
{

using Settings = std::vector<std::string>;

/// The run of a scene, wherever it stops.
inline SceneRun stopped(const std::string &scene, const Settings &overrides = {})
{
  const test::SceneFolder folder;
  return SceneRun(folder.write("scene.toml", scene), overrides);
}

/// The run of a scene, which must come to its end.
inline SceneRun run(const std::string &scene, const Settings &overrides = {})
{
  SceneRun motion = stopped(scene, overrides);
  EXPECT_EQ(motion.result.failure, "");
  return motion;
}

inline void expect_complaint(const std::string &scene, const std::string &words, const Settings &overrides = {})
{
  EXPECT_THAT(test::complaint(scene, overrides), ::testing::HasSubstr(words));
}

/// Observed order of a method of which the second error is that of half the step.
inline double order(double coarse, double fine)
{
  return std::log2(coarse / fine);
}

/// Time of the n-th event of a kind, from 0.
inline double time_of(const SceneRun &motion, const std::string &kind, int n = 0)
{
  for (const coupling::Event &event : motion.result.events)
    if (event.kind == kind && n-- == 0)
      return event.t;
  ADD_FAILURE() << "no event " << kind;
  return std::nan("");
}

inline int count(const SceneRun &motion, const std::string &kind)
{
  int n = 0;
  for (const coupling::Event &event : motion.result.events)
    n += event.kind == kind;
  return n;
}

inline void expect_closed_balance(const SceneRun &motion, double part)
{
  const auto &energy = motion.result.energy;
  EXPECT_EQ(motion.result.failure, "");
  EXPECT_LT(std::abs(energy.residual), part * (std::abs(energy.input) + std::abs(energy.stored) + energy.dissipated));
}

/// One body, to which elements are added; the first step is the fixed one.
inline std::string rotor(double inertia, const std::string &end)
{
  return rotor_body("shaft", std::to_string(inertia), "[0, 0, 1]") + steps("0.1 ms", end) +
         "[output.signals]\nw = \"shaft.speed\"\nphi = \"shaft.angle\"\n";
}
inline std::string slider(double mass, const std::string &end)
{
  return slider_body("slide", std::to_string(mass), "[1, 0, 0]") + steps("0.1 ms", end) +
         "[output.signals]\nx = \"slide.displacement\"\nv = \"slide.velocity\"\n";
}

// Fixed steps, and controlled ones up to 20 ms.
inline const Settings fixed = {}, controlled = {"run.tolerance=1e-8", "run.step=20 ms"};

} // namespace gestell::tests

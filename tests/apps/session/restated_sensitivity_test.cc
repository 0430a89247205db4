// Derivatives of a machine are the same in any plane and in any order of its tables.

#include "apps/scene/file/scene_file.h"
#include "apps/scene/scene.h"
#include "apps/session/session.h"
#include "tests/support/moved_scene.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::tests
{
namespace
{

using apps::SceneNode;
using apps::SensitivityOutput;

const char *const scene = "double_four_bar.toml";
const char *const keys = "parameters.r,parameters.mu,parameters.x_C0,body.crank.inertia,element.motor.breakdown_torque";

std::map<std::string, SensitivityOutput> derivatives(const SceneNode &tree)
{
  apps::Session session(apps::read_scene(tree, shipped(scene), fem::Scripts::harmless), {}, {});
  session.take_entries(tree);
  const apps::Result result = session.run(keys);
  EXPECT_EQ(result.sensitivities->failure, "");
  std::map<std::string, SensitivityOutput> outputs;
  for (const SensitivityOutput &output : result.sensitivities->outputs)
    outputs[output.output] = output;
  return outputs;
}

SceneNode original()
{
  return apps::read_scene_file(shipped(scene), {"run.end=0.5 s"});
}

// Instants of peaks move by a small rate over a small curvature, as in sensitivity_identities_test.cc.
constexpr double same_value = 1e-7, same_instant = 1e-4;

bool is_of_time(const std::string &output)
{
  const std::string what = output.substr(output.rfind('.') + 1);
  return what == "t_min" || what == "t_max" || what == "t";
}

/// Of all outputs of the original; relative to the largest derivative of the same unit by that key.
void expect_same(const std::map<std::string, SensitivityOutput> &one,
                 const std::map<std::string, SensitivityOutput> &other)
{
  ASSERT_GT(one.size(), 20u);
  for (Eigen::Index k = 0; k < 5; ++k)
  {
    std::map<std::string, double> size;
    for (const auto &[name, output] : one)
      if (std::isfinite(output.derivative[k]))
        size[output.unit] = std::max(size[output.unit], std::abs(output.derivative[k]));
    for (const auto &[name, output] : one)
    {
      const auto found = other.find(name);
      ASSERT_NE(found, other.end()) << name;
      EXPECT_EQ(std::isfinite(output.derivative[k]), std::isfinite(found->second.derivative[k])) << name;
      if (!std::isfinite(output.derivative[k]))
        continue;
      EXPECT_NEAR(output.derivative[k], found->second.derivative[k],
                  (is_of_time(name) ? same_instant : same_value) * size[output.unit])
          << name << ", " << k;
    }
  }
}

// Its signals are angles, torques and sizes of forces: no component.
TEST(RestatedSensitivities, InAnotherPlaneAreTheSame)
{
  const auto here = derivatives(original());
  for (const unsigned seed : {1u, 2u})
    expect_same(here, derivatives(moved(original(), {random_rotation(seed), {0.3, -1.1, 0.7}}).scene));
}

TEST(RestatedSensitivities, InAnotherOrderAreTheSame)
{
  expect_same(derivatives(original()), derivatives(reordered(original(), 1)));
}

} // namespace
} // namespace gestell::tests

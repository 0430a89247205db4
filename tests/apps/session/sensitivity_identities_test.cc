// Buckingham's identities: how outputs change with the units of length, mass and time is known, whatever the machine.
// Derivatives of a machine are the same in any plane and in any order of its tables.
// Derivatives of some shipped scenes, by entries drawn at random, against converged differences of runs; of all scenes:
// sensitivity_long_test.cc.

#include "apps/scene/file/scene_file.h"
#include "apps/scene/scene.h"
#include "apps/session/session.h"
#include "tests/apps/session/differentiated.h"
#include "tests/apps/session/sensitivity_comparison.h"
#include "tests/support/moved_scene.h"
#include "tests/support/scaled_scene.h"
#include "tests/support/scene_run.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::SensitivityOutput;
using apps::Session;

/// "F_P" of "F_P.t_max", "events" of "events.3.t".
std::string signal_of(const std::string &output)
{
  return output.compare(0, 7, "events.") == 0 ? "events" : output.substr(0, output.rfind('.'));
}

bool is_time(const std::string &output)
{
  const std::string what = output.substr(output.rfind('.') + 1);
  return what == "t" || what == "t_min" || what == "t_max";
}

/// A scene of apps/scenes, shortened and by a method exact enough to be the motion that its equations have.
struct Shipped
{
  std::string              scene;
  std::vector<std::string> overrides;
  double                   error;       ///< of derivatives, relative to the largest value of their signal
  double                   of_instants; ///< likewise of instants of peaks
};

using Identities = ::testing::TestWithParam<Shipped>;

TEST_P(Identities, OfLengthMassAndTimeHold)
{
  const Shipped          &shipped = GetParam();
  const test::SceneFolder folder;
  const std::string       path = test::write_scaled_scene(shipped.scene, folder.path(""));
  std::string             keys;
  for (const char *scale : test::scales)
    keys += (keys.empty() ? "parameters." : ",parameters.") + std::string(scale);
  const apps::Result result = differentiated(Session(path, shipped.overrides), keys);
  const auto         found  = sensitivities_of(result);
  ASSERT_EQ(found.failure, "");
  std::map<std::string, double> sizes;
  for (const SensitivityOutput &output : found.outputs)
    if (!is_time(output.output))
    {
      double &size = sizes[signal_of(output.output)];
      size         = std::max(size, std::abs(output.value));
    }
  const double end      = result.run->rows[result.run->rows.size() - result.run->columns.size()];
  int          reported = 0;
  for (const SensitivityOutput &output : found.outputs)
  {
    const bool   frequency = signal_of(output.output) == "modes", instant = is_time(output.output);
    const double size  = frequency ? std::abs(output.value) : instant ? end : sizes[signal_of(output.output)];
    const auto   power = test::exponents(output.unit);
    for (std::size_t k = 0; k < test::scales.size(); ++k)
    {
      const double derivative = output.derivative[Eigen::Index(k)];
      if (!std::isfinite(derivative))
      {
        EXPECT_NE(output.note, "") << output.output;
        continue;
      }
      ++reported;
      EXPECT_NEAR(derivative, power[k] * output.value, (instant ? shipped.of_instants : shipped.error) * size)
          << output.output << " by " << test::scales[k] << ", of " << output.value << ' ' << output.unit;
    }
  }
  EXPECT_GT(reported, 0);
}

// Errors are those of runs with these tolerances, across events larger than without; forces of stiff contacts enlarge
// them by the stiffness, and the instants of flat peaks are those of a small rate over a small curvature.  What is
// missing or wrong in a derivative is a share of its output.
INSTANTIATE_TEST_SUITE_P(
    OfShippedScenes, Identities,
    ::testing::Values(
        Shipped{"crane_minimal.toml", {"run.tolerance=1e-10", "run.end=(5 s)*scale_of_time"}, 2e-6, 1e-4},
        Shipped{"press_minimal.toml", {"run.tolerance=1e-10", "parameters.t_end=(0.25 s)*scale_of_time"}, 1e-4, 1e-3},
        Shipped{"crank_press_joints.toml", {"run.tolerance=1e-10", "run.end=(0.4 s)*scale_of_time"}, 1e-4, 1e-4},
        Shipped{"double_four_bar.toml", {"run.tolerance=1e-9", "run.end=(1 s)*scale_of_time"}, 1e-6, 1e-4},
        Shipped{"run_up.toml", {"run.tolerance=1e-9", "run.end=(0.5 s)*scale_of_time"}, 1e-5, 1e-5},
        Shipped{"cam_follower.toml", {"run.tolerance=1e-9", "run.end=(0.2 s)*scale_of_time"}, 1e-3, 1e-3}),
    [](const auto &info) { return info.param.scene.substr(0, info.param.scene.find('.')); });

using apps::SceneNode;

const char *const scene = "double_four_bar.toml";
const char *const keys = "parameters.r,parameters.mu,parameters.x_C0,body.crank.inertia,element.motor.breakdown_torque";

std::map<std::string, SensitivityOutput> derivatives(const SceneNode &tree)
{
  apps::Session session(apps::Variant{tree, shipped(scene)});
  const auto    found = sensitivities_of(differentiated(std::move(session), keys));
  EXPECT_EQ(found.failure, "");
  std::map<std::string, SensitivityOutput> outputs;
  for (const SensitivityOutput &output : found.outputs)
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

TEST(SensitivitiesOfShippedScenes, AreDifferencesOfConvergedRuns)
{
  // A mechanism with joints that is switched, a position function, and a play with a sheet that breaks.
  for (const auto &[scene, end] : {std::pair("crank_press_joints.toml", "0.6 s"),
                                   std::pair("geneva_drive.toml", "0.7 s"), std::pair("press_minimal.toml", "0.3 s")})
  {
    const Comparison found =
        compared_with_differences({scene, {"run.tolerance=1e-11", std::string("run.end=") + end}, 2e-4, 3, 4});
    EXPECT_GT(found.smooth.converged, 10) << scene;
    EXPECT_GT(found.events.converged, 10) << scene;
    EXPECT_TRUE(found.beyond.empty()) << found.beyond.front();
  }
}

} // namespace
} // namespace gestell::tests

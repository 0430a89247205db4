#pragma once

#include "apps/scene/file/scene_file.h"
#include "tests/support/moved_scene.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gestell::tests
{

/// A machine with joints: a shipped scene, one of apps/verification/scenes, or a text.
struct JointedMachine
{
  std::string              name;
  std::string              scene; ///< file, or the text itself
  std::vector<std::string> overrides{};
  double                   length = 1.;   ///< [m] of its size: moved much further, its places are known less well
  double                   same   = 1e-9; ///< of the largest value of each signal

  friend void PrintTo(const JointedMachine &machine, std::ostream *out) { *out << machine.name; }

  apps::SceneNode tree() const
  {
    if (scene.find('\n') == std::string::npos)
      return apps::read_scene_file(path(), overrides);
    const test::SceneFolder folder;
    return apps::read_scene_file(folder.write("scene.toml", scene), overrides);
  }
  std::string path() const
  {
    if (scene.find('\n') != std::string::npos)
      return "scene.toml";
    return scene.find('/') == std::string::npos ? shipped(scene) : std::string(GESTELL_SOURCE_DIR) + '/' + scene;
  }
};

/// A crank on a rotor, coupler and rocker, driven by a torque.
inline std::string four_bar_with_rotor()
{
  return "gravity = [0, 0, -9.81]\n" + rotor_body("crank", "0.5", "[0, 1, 0]") +
         planar_body("coupler", "2", "0.1", "[0.4, 0, 0.4]") + planar_body("rocker", "1.5", "0.05", "[0.9, 0, 0.25]") +
         revolute("A", "crank", "coupler", "[0, 0, 0.3]") + revolute("B", "coupler", "rocker", "[0.8, 0, 0.5]") +
         revolute("B0", "ground", "rocker", "[1, 0, 0]") +
         element("drive", "force", {{"from", "crank"}, {"about", "[0, 1, 0]"}, {"constant", "3 N m"}}) +
         steps("1 ms", "0.5 s") +
         signals("phi = 'crank.angle', w = 'crank.speed', psi = 'rocker.angle', x = 'coupler.x', z = 'coupler.z'");
}

/// A bead on an arm of a rotor that it slides along, on a spring.
inline std::string bead_on_a_rotor()
{
  return "gravity = [0, 0, -9.81]\n" + rotor_body("wheel", "0.5", "[0, 1, 0]") +
         planar_body("bead", "0.5", "0.001", "[0.2, 0, 0]") +
         joint("arm", "prismatic", "wheel", "bead", "[0.2, 0, 0]", {{"axis", "[1, 0, 0]"}}) +
         measure("way", "distance", {{"from", "wheel"}, {"to", "bead"}}) +
         element("spring", "spring-damper", {{"on", "way"}, {"stiffness", "400 N/m"}, {"damping", "2 N s/m"}}) +
         start("v = { wheel = 5 }") + steps("0.5 ms", "0.5 s") +
         signals("phi = 'wheel.angle', d = 'way.value', x = 'bead.x', z = 'bead.z'");
}

/// Shafts welded end to end, and slides pinned to each other, none of which has a plane.
inline std::string shafts_and_slides()
{
  return rotor_body("a", "0.5", "[0, 1, 0]") + rotor_body("b", "0.2", "[0, 1, 0]") +
         slider_body("s", "2", "[1, 0, 0]") + slider_body("t", "3", "[1, 0, 0]") +
         joint("weld", "rigid", "a", "b", "[0, 0.1, 0]") + revolute("pin", "s", "t", "[0.2, 0, 0.1]") +
         element("torque", "force", {{"from", "a"}, {"about", "[0, 1, 0]"}, {"constant", "3 N m"}}) +
         element("push", "force", {{"from", "s"}, {"direction", "[1, 0, 0]"}, {"constant", "7 N"}}) +
         steps("1 ms", "0.1 s") + signals("phi = 'b.angle', x = 't.displacement'");
}

/// A double pendulum of planar bodies with arms of that length [m], with a tolerance.
inline std::string double_pendulum(double arm, const std::string &tolerance)
{
  const double      m = 1000. * arm * arm * arm, J = m * arm * arm / 12., period = 2. * M_PI * std::sqrt(arm / 9.81);
  const std::string mass = number(m), inertia = number(J);
  return "gravity = [0, 0, -9.81]\n" + planar_body("first", mass, inertia, vector(arm / 2, 0, 0)) +
         planar_body("second", mass, inertia, vector(arm, 0, -arm / 2)) +
         revolute("top", "ground", "first", "[0, 0, 0]") + revolute("knee", "first", "second", vector(arm, 0, 0)) +
         "[run]\nmethod = \"bdf\"\ntolerance = " + tolerance + "\nend = " + number(period) + "\n" +
         signals("phi = 'first.angle', psi = 'second.angle', w = 'second.speed', x = 'second.x', F = 'knee.resultant'",
                 {{"step", number(period / 50.)}});
}

/// All whose history does not depend on rounding as chaos does.
inline std::vector<JointedMachine> jointed_machines()
{
  return {{"double_four_bar", "double_four_bar.toml", {"run.end=1 s"}},
          {"crank_press_joints", "crank_press_joints.toml", {"run.end=0.1 s"}},
          // Places know 1 m to 1e-16 m, which pins of 200 kN/mm make 4e-8 N of 40 N.
          {"offset_four_bar", "offset_four_bar.toml", {"run.end=0.5 s"}, 1., 1e-8},
          {"slider_crank_journal", "slider_crank_journal.toml", {"run.end=5 ms"}, 0.1},
          {"spatial_crank_rocker", "spatial_crank_rocker.toml", {"run.end=0.5 s"}},
          {"crane_minimal", "crane_minimal.toml", {"run.end=0.5 s"}},
          {"four_bar_with_rotor", four_bar_with_rotor()},
          {"bead_on_a_rotor", bead_on_a_rotor()},
          {"shafts_and_slides", shafts_and_slides()},
          // Controlled steps are others in another plane: a thousand tolerances.
          {"slider_crank",
           "apps/verification/scenes/slider_crank.toml",
           {"run.end=0.2 s", "run.tolerance=1e-11"},
           0.2,
           1e-8},
          // Forces 5e-9: steps are controlled down to what rounding leaves in levers of 1 mm.
          {"andrews", "apps/verification/scenes/andrews.toml", {"run.end=10 ms", "run.tolerance=1e-11"}, 0.02, 3e-8},
          {"conical_pendulum", "apps/verification/scenes/conical_pendulum.toml", {"run.end=0.5 s"}},
          {"pendulum", "apps/verification/scenes/pendulum.toml", {"run.end=0.5 s", "start.v.\"bob.angle\"=2"}},
          {"point_pendulum", "apps/verification/scenes/point_pendulum.toml", {"run.end=0.5 s"}},
          {"free_top", "apps/verification/scenes/top.toml", {"run.end=0.5 s"}}};
}

/// The machine moved as a whole does what it did, in all signals.  @return the worst
inline Deviation expect_same_moved(const JointedMachine &machine, const std::vector<RigidMotion> &motions)
{
  const auto tree     = with_resultants(machine.tree());
  const auto original = run_of(tree, machine.path());
  Deviation  worst;
  EXPECT_EQ(original.failure, "") << machine.name;
  for (std::size_t i = 0; i < motions.size(); ++i)
    try
    {
      const Restated there = moved(tree, motions[i]);
      const auto     run   = run_of(there.scene, machine.path());
      EXPECT_EQ(run.failure, "") << machine.name << ", motion " << i;
      const Deviation own = largest_deviation(original, run, there.signals);
      EXPECT_LE(own.value, machine.same) << machine.name << ", motion " << i << ": " << own.signal;
      if (!(own.value <= worst.value))
        worst = own;
    }
    catch (const std::exception &refusal)
    {
      ADD_FAILURE() << machine.name << ", motion " << i << ": " << refusal.what();
    }
  return worst;
}

} // namespace gestell::tests

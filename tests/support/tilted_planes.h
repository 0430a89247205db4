#pragma once

#include "apps/scene/file/scene_file.h"
#include "tests/support/moved_scene.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

#include <random>

namespace gestell::tests
{

/// A machine with joints: a shipped scene, one of apps/verification/scenes, or a text.
struct JointedMachine
{
  std::string              name;
  std::string              scene; ///< file, or the text itself
  std::vector<std::string> overrides{};
  double                   length = 1.;   ///< [m] of its size: moved much further, its places are known less well
  double                   same   = 1e-9; ///< of the largest value of each signal, where rounding of places leaves less

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

/// Frames that move along one axis alone, with the two others as well: no rows of matrices say "along this direction".
inline std::vector<std::string> with_all_rows(const std::string &interface, const std::array<std::string, 3> &motions,
                                              const std::string &mass, const std::array<std::string, 3> &stiffnesses)
{
  const auto diagonal = [](const std::array<std::string, 3> &d)
  { return "[[\"" + d[0] + "\", 0, 0], [0, \"" + d[1] + "\", 0], [0, 0, \"" + d[2] + "\"]]"; };
  return {"frame.mass=" + diagonal({mass, mass, mass}), "frame.stiffness=" + diagonal(stiffnesses),
          "frame.interface." + interface + ".rows={ " + motions[0] + " = 1, " + motions[1] + " = 2, " + motions[2] +
              " = 3 }"};
}

/// crane_minimal_elastic.toml with the springs of its chassis one by one: those of one joint count along global axes.
inline std::string crane_on_three_springs()
{
  const Keys between{{"from", "chassis"}, {"to", "turret"}};
  const auto spring = [&between](const std::string &name, const std::string &axis, const std::string &stiffness)
  {
    return table("joint." + name, between,
                 {{"type", "in-plane"},
                  {"at", "['-1.313 m', 0, '0.463 m']"},
                  {"axis", axis},
                  {"stiffness", stiffness},
                  {"damping", "100 kN s/m"}});
  };
  return "extends = \"" + shipped("crane_minimal_elastic.toml") + "\"\nwithout = [\"joint.springs\"]\n" +
         spring("along", "[1, 0, 0]", "279 MN/m") + spring("upright", "[0, 0, 1]", "219 MN/m") +
         measure("pitch", "angle", {{"from", "chassis"}, {"to", "turret"}, {"about", "[0, 1, 0]"}}) +
         element("pitching", "spring-damper",
                 {{"on", "pitch"}, {"stiffness", "360 MN m/rad"}, {"damping", "100 kN m s/rad"}});
}

/// spatial_crank_rocker.toml on a reduced frame: its pedestals turn as well, and three modes of the inside swing along.
inline std::string spatial_on_modes()
{
  constexpr int       n = 15;
  std::mt19937        random(7);
  Eigen::MatrixXd     M = Eigen::MatrixXd::Identity(n, n), C = M;
  std::vector<double> mass, omega;
  for (int i = 0; i < n; ++i)
  {
    mass.push_back(i >= 12 ? 1. : i % 6 < 3 ? 60. : 2.);
    omega.push_back(i >= 12 ? 200. + 100. * (i - 12) : 60. + 10. * (i % 5));
    for (int k = 0; k < i; ++k)
    {
      M(i, k) = M(k, i) = (double(random()) / 4294967295. - 0.5) / n;
      C(i, k) = C(k, i) = (double(random()) / 4294967295. - 0.5) / n;
    }
  }
  const auto rows = [n](const auto &entry, int width)
  {
    std::string text = "[";
    for (int i = 0; i < n; ++i)
    {
      text += i > 0 ? ", [" : "[";
      for (int k = 0; k < width; ++k)
        text += (k > 0 ? ", " : "") + number(entry(i, k));
      text += "]";
    }
    return text + "]";
  };
  const auto m = [&](int i, int k) { return M(i, k) * std::sqrt(mass[i] * mass[k]); };
  const auto c = [&](int i, int k) { return C(i, k) * std::sqrt(mass[i] * mass[k]) * omega[i] * omega[k]; };
  const auto t = [](int i, int d) { return i < 12 && i % 6 == d ? 1. : 0.; };
  return "extends = \"" + shipped("spatial_crank_rocker.toml") +
         "\"\nwithout = [\"frame.interface\", \"frame.damping\"]\n[frame]\nmass = " + rows(m, n) +
         "\nstiffness = " + rows(c, n) + "\ntranslations = " + rows(t, 3) +
         "\ndamping = { ratio = 0.02 }\n[frame.interface.bearing]\nrows = { ux = 1, uy = 2, uz = 3, rx = 4, ry = 5, rz "
         "= 6 }\nposition = [0, 0, 0]\n[frame.interface.pivot]\nrows = { ux = 7, uy = 8, uz = 9, rx = 10, ry = 11, rz "
         "= "
         "12 }\nposition = [\"x_B0\", 0, 0]\n";
}

/// The overrides of several things.
inline std::vector<std::string> joined(std::vector<std::string> some, const std::vector<std::string> &more)
{
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

/// All whose history does not depend on rounding as chaos does.
inline std::vector<JointedMachine> jointed_machines()
{
  return {
      {"double_four_bar", "double_four_bar.toml", {"run.end=1 s"}},
      {"crank_press_joints", "crank_press_joints.toml", {"run.end=0.1 s"}},
      {"offset_four_bar", "offset_four_bar.toml", {"run.end=0.5 s"}},
      // The angle of a journal in the middle of its bearing is undetermined.
      {"slider_crank_journal", "slider_crank_journal.toml", {"run.end=5 ms", "output.signals.angle=crank.angle"}, 0.25},
      {"spatial_crank_rocker", "spatial_crank_rocker.toml", {"run.end=0.5 s"}},
      {"spatial_on_modes", spatial_on_modes(), {"run.end=0.5 s"}},
      {"crane_minimal", "crane_minimal.toml", {"run.end=0.5 s"}},
      {"four_bar_with_rotor", four_bar_with_rotor()},
      {"bead_on_a_rotor", bead_on_a_rotor()},
      {"shafts_and_slides", shafts_and_slides()},
      {"cam_follower", "cam_follower.toml",
       joined({"run.end=50 ms"},
              with_all_rows("bearing", {"ux", "uy", "uz"}, "12 kg", {"80 kN/mm", "100 kN/mm", "60 kN/mm"})),
       0.1},
      {"geneva_drive", "geneva_drive.toml",
       joined({"run.end=0.5 s"}, with_all_rows("housing", {"rx", "ry", "rz"}, "0.6 kg m^2",
                                               {"700 kN m/rad", "800 kN m/rad", "900 kN m/rad"})),
       0.1},
      {"crane_on_three_springs", crane_on_three_springs(), {"run.end=0.2 s"}},
      {"slider_crank",
       "apps/verification/scenes/slider_crank.toml",
       {"run.end=0.2 s", "run.tolerance=1e-11", "parameters.omega=30 rad/s"},
       0.5},
      // Turned 1e-10; moved away as well 1.3e-8, ten times what rounding of its places makes where it stands,
      // presumably as forces of joints are positions over the square of controlled steps, whose rounding grows with the
      // distance.
      {"andrews", "apps/verification/scenes/andrews.toml", {"run.end=10 ms", "run.tolerance=1e-11"}, 0.02, 3e-8},
      {"conical_pendulum", "apps/verification/scenes/conical_pendulum.toml", {"run.end=0.5 s"}},
      {"pendulum", "apps/verification/scenes/pendulum.toml", {"run.end=0.5 s", "start.v.\"bob.angle\"=2"}},
      {"point_pendulum", "apps/verification/scenes/point_pendulum.toml", {"run.end=0.5 s"}},
      {"free_top", "apps/verification/scenes/top.toml", {"run.end=0.5 s"}}};
}

/**
 * What rounding of the scene's places alone makes of the answers: the largest deviation of the machine where it stands,
 * each place moved by up to one rounding error of the machine's length.  A rotation leaves as much of three products
 * and two sums, so that answers in any plane are known to no more.
 */
inline Deviation known_to(const apps::SceneNode &tree, const JointedMachine &machine,
                          const coupling::RunResult &original)
{
  Deviation worst;
  for (unsigned seed = 1; seed <= 8; ++seed)
  {
    RigidMotion motion;
    motion.noise         = machine.length * std::numeric_limits<double>::epsilon();
    motion.seed          = seed;
    const Restated noisy = moved(tree, motion);
    if (const Deviation own = largest_deviation(original, run_of(noisy.scene, machine.path()), noisy.signals);
        !(own.value <= worst.value))
      worst = own;
  }
  return worst;
}

/// The machine moved as a whole does what it did, in all signals: to 1e-9, or ten times what rounding of its places
/// makes of them, as every step rounds as well.  @return the worst
inline Deviation expect_same_moved(const JointedMachine &machine, const std::vector<RigidMotion> &motions)
{
  const auto tree     = with_resultants(machine.tree());
  const auto original = run_of(tree, machine.path());
  double     same     = machine.same;
  Deviation  worst;
  EXPECT_EQ(original.failure, "") << machine.name;
  for (std::size_t i = 0; i < motions.size(); ++i)
    try
    {
      const Restated there = moved(tree, motions[i]);
      const auto     run   = run_of(there.scene, machine.path());
      EXPECT_EQ(run.failure, "") << machine.name << ", motion " << i;
      const Deviation own = largest_deviation(original, run, there.signals);
      if (!(own.value <= same) && same == machine.same)
        same = std::max(same, 10. * known_to(tree, machine, original).value);
      EXPECT_LE(own.value, same) << machine.name << ", motion " << i << ": " << own.signal;
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

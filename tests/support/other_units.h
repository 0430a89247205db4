#pragma once

#include "apps/scene/file/scene_file.h"
#include "tests/support/rescaled_scene.h"
#include "tests/support/test.h"
#include "tests/support/tilted_planes.h"

namespace gestell::tests
{

/// Scenes without a mesh.  Lengths of andrews.toml have no unit.  The rope of the elastic crane starts with a rate that
/// is zero but for the rounding of springs beside the weight, 1e-14 rad/s, which is 5e-7 of the angle it reaches: zeros
/// cancel to the last bit in SI units alone.
inline std::vector<JointedMachine> machines_without_mesh()
{
  std::vector<JointedMachine> machines = jointed_machines();
  const auto                  left_out = [](const JointedMachine &machine)
  { return machine.name == "andrews" || machine.name == "crane_on_three_springs"; };
  machines.erase(std::remove_if(machines.begin(), machines.end(), left_out), machines.end());
  const auto add = [&machines](const std::string &name, const std::vector<std::string> &overrides) {
    machines.push_back({name, name + ".toml", overrides});
  };
  add("crane_minimal_lift", {"run.end=0.3 s"});
  add("press_minimal", {"parameters.t_end=0.1 s"});
  add("press_minimal_light", {"parameters.t_end=0.1 s"});
  add("press_emergency_stop", {"parameters.t_end=0.1 s"});
  add("press_strokes", {"parameters.t_end=0.2 s"});
  add("run_up", {"run.end=0.5 s"});
  const auto verified = [&machines](const std::string &name, const std::vector<std::string> &overrides) {
    machines.push_back({name, "apps/verification/scenes/" + name + ".toml", overrides});
  };
  verified("clearance_forced", {});
  verified("dry_friction", {"parameters.F=20 N"});
  verified("duffing_forced", {"parameters.beta=1 N/m^3"});
  verified("impact", {});
  verified("resonance_passage", {"run.end=50 s"});
  verified("two_masses", {});
  verified("two_masses_cubic", {});
  verified("four_bars_1", {"run.end=0.2 s"});
  return machines;
}

/// 4096 times smaller and larger units of length, mass and time, each alone, and all at once.
inline std::vector<UnitPowers> other_units()
{
  return {{12, 0, 0}, {-12, 0, 0}, {0, 12, 0}, {0, -12, 0}, {0, 0, 12}, {0, 0, -12}, {-8, 6, -10}};
}

inline std::string text_of(const UnitPowers &powers)
{
  return "2^(" + std::to_string(powers[0]) + ", " + std::to_string(powers[1]) + ", " + std::to_string(powers[2]) + ")";
}

/// What differs most between a run and one in other units: of the largest value of a signal, of the energy exchanged,
/// of the end of the run.
inline Deviation deviation_of(const coupling::RunResult &original, const coupling::RunResult &rescaled,
                              const UnitPowers &powers)
{
  const std::size_t width = original.columns.size();
  if (original.failure.empty() != rescaled.failure.empty())
    return {"failure: " + original.failure + rescaled.failure, 1.};
  if (original.rows.size() != rescaled.rows.size() || original.events.size() != rescaled.events.size())
    return {"other rows or events", 1.};
  Deviation  worst;
  const auto add = [&worst](const std::string &name, double off, double size)
  {
    if (size > 0. && !(off / size <= worst.value))
      worst = {name, off / size};
  };
  for (std::size_t column = 0; column < width; ++column)
  {
    const double by   = growth(powers, original.units[column]);
    double       size = original.units[column] == "J" ? original.energy.exchanged : 0., off = 0.;
    for (std::size_t i = column; i < original.rows.size(); i += width)
    {
      size = std::max(size, std::abs(original.rows[i]));
      off  = std::max(off, std::abs(rescaled.rows[i] / by - original.rows[i]));
    }
    add(original.columns[column], off, size);
  }
  const double end = original.rows.empty() ? 0. : original.rows[original.rows.size() - width];
  for (std::size_t i = 0; i < original.events.size(); ++i)
    add("event " + std::to_string(i), std::abs(rescaled.events[i].t / growth(powers, "s") - original.events[i].t), end);
  return worst;
}

/// A machine in other units; what is refused in them counts as 1.
inline Deviation deviation_in_other_units(const JointedMachine &machine, const std::vector<UnitPowers> &units)
{
  const auto tree     = machine.tree();
  const auto original = run_of(tree, machine.path());
  Deviation  worst;
  for (const UnitPowers &powers : units)
  {
    Deviation own;
    try
    {
      own = deviation_of(original, run_of(rescaled(tree, powers).scene, machine.path()), powers);
    }
    catch (const std::exception &refusal)
    {
      own = {refusal.what(), 1.};
    }
    if (!(own.value <= worst.value))
      worst = {own.signal + " in units " + text_of(powers), own.value};
  }
  return worst;
}

/// What rounding of the places in the scene makes of the answers.
inline double rounding_of_places(const JointedMachine &machine)
{
  const auto tree     = machine.tree();
  const auto original = run_of(tree, machine.path());
  double     worst    = 0.;
  for (unsigned seed = 1; seed <= 4; ++seed)
  {
    RigidMotion noise;
    noise.noise = machine.length * std::numeric_limits<double>::epsilon();
    noise.seed  = seed;
    worst       = std::max(worst, deviation_of(original, run_of(moved(tree, noise).scene, machine.path()), {}).value);
  }
  return worst;
}

/// The machine does the same in other units: to 1e-10, or ten times what rounding of its places makes of it, as
/// every step rounds as well.
/// @return the worst
inline Deviation expect_same_in_other_units(const JointedMachine &machine, const std::vector<UnitPowers> &units)
{
  const Deviation worst = deviation_in_other_units(machine, units);
  const double    same  = worst.value <= 1e-10 ? 1e-10 : std::max(1e-10, 10. * rounding_of_places(machine));
  EXPECT_LE(worst.value, same) << machine.name << ": " << worst.signal;
  return worst;
}

} // namespace gestell::tests

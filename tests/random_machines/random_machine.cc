#include "tests/random_machines/random_machine.h"

#include "tests/random_machines/draft.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace gestell::tests
{

double size_of(const RandomMachine &machine, const std::string &signal)
{
  if (const auto found = machine.sizes.find(signal); found != machine.sizes.end())
    return found->second;
  const std::string quantity = signal.substr(signal.rfind('.') + 1);
  for (const char *speed : {"velocity", "speed", "rate", "ux_rate", "wanted_speed", "wx", "wy", "wz"})
    if (quantity == speed)
      return machine.speed;
  for (const char *force : {"force", "torque"})
    if (quantity == force)
      return machine.force;
  return machine.length;
}

/// Machines that found something are kept by their seeds; what is new is made from later ones.
constexpr std::uint64_t last_without_presses = 2000, last_narrow = 2200;

namespace
{

/// Half of them have a twin; the others are of the kinds of earlier seeds, and some have switches.
void write_wide(Draft &draft)
{
  static constexpr void (*others[])(Draft &) = {write_press,   write_train,   write_train, write_framed,
                                                write_linkage, write_spatial, write_gears};
  draft.machine.wide                         = true;
  const double kind                          = draft.dice.share();
  if (kind < 0.3)
    return write_hinged(draft);
  if (kind < 0.6)
    return write_shafts(draft);
  others[draft.dice.whole(int(std::size(others)))](draft);
  if (draft.dice.chance(0.6))
    add_switches(draft);
}

/// What is released moves as far as weight takes it.
RandomMachine with_falls(RandomMachine machine)
{
  machine.length = std::max(machine.length, machine.fall_length);
  machine.speed  = std::max(machine.speed, machine.fall_speed);
  machine.force  = std::max(machine.force, machine.weight);
  return machine;
}

} // namespace

RandomMachine random_machine(std::uint64_t seed)
{
  RandomMachine machine;
  Dice          dice(seed);
  Draft         draft(machine, dice);
  machine.seed  = seed;
  machine.scene = "name = \"random_" + std::to_string(seed) + "\"\n";
  if (seed > last_narrow)
  {
    write_wide(draft);
    return with_falls(std::move(machine));
  }
  const double kind = dice.share();
  if (seed > last_without_presses && dice.chance(0.25))
    write_press(draft);
  else if (kind < 0.45)
    write_train(draft);
  else if (kind < 0.65)
    write_framed(draft);
  else if (kind < 0.8)
    write_linkage(draft);
  else if (kind < 0.86)
    write_spatial(draft);
  else
    write_gears(draft);
  return with_falls(std::move(machine));
}

} // namespace gestell::tests

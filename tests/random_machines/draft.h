#pragma once

#include "tests/random_machines/dice.h"
#include "tests/random_machines/random_machine.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gestell::tests
{

/// The sizes that all of a machine's numbers are drawn around.
struct Scale
{
  double mass = 1., omega = 1., length = 1.; ///< [kg, rad/s, m], or [kg m^2, rad/s, rad]

  double stiffness() const { return mass * omega * omega; }
  double damping() const { return mass * omega; }
  double force() const { return stiffness() * length; }
  double speed() const { return omega * length; }
};

/// A motion u that laws act on.
struct Link
{
  std::string entries; ///< "from = ...", with line ends
  bool        turns = false;
  Scale       scale;
  bool        on_measure = false; ///< not a constant combination of coordinates
  int         from = 0, to = -1;  ///< numbers of the motions it joins
  std::string shaft;              ///< entries of a motor that turns it; empty: none may
};

/// A scene while it is being written.
class Draft
{
public:
  Draft(RandomMachine &machine, Dice &dice) : machine(machine), dice(dice) {}

  void table(const std::string &head) { machine.scene += "\n[" + head + "]\n"; }
  void line(const std::string &text) { machine.scene += text + "\n"; }
  void text(const std::string &key, const std::string &value) { line(key + " = \"" + value + "\""); }
  /// Written with four digits; @return the value as it is read
  double number(const std::string &key, double value);
  void   watch(const std::string &path) { machine.signals.push_back(path); }
  void   watch(const std::string &path, double size)
  {
    watch(path);
    machine.sizes[path] = size;
  }
  /// "e1", "e2", ...
  std::string new_name(const std::string &letter) { return letter + std::to_string(++count_); }

  RandomMachine           &machine;
  Dice                    &dice;
  std::vector<std::string> elements; ///< names of those that a switch may turn off

  /// What sticks holds two motions together (-1: the ground): false if they are held already.
  bool may_stick(int a, int b)
  {
    const int root_a = root(a + 1), root_b = root(b + 1);
    if (root_a == root_b)
      return false;
    held_[root_a] = root_b;
    return true;
  }

private:
  int root(int motion)
  {
    const auto found = held_.find(motion);
    return found == held_.end() ? motion : root(found->second);
  }

  std::map<int, int> held_;
  int                count_ = 0;
};

/// Four digits, and what they are read as.
std::string digits(double value);
double      rounded(double value);

/// "[x, y, z]"
std::string vector_text(double x, double y, double z);

/// Machines of each kind; they leave the scene complete but for [run] and [output].
void write_train(Draft &draft);
void write_framed(Draft &draft);
void write_linkage(Draft &draft);
void write_gears(Draft &draft);
void write_spatial(Draft &draft);
void write_press(Draft &draft);
void write_hinged(Draft &draft);
void write_shafts(Draft &draft);

/// What the scale says of a machine as a whole, and how long it runs.
void set_times(Draft &draft, const Scale &scale, double fewest, double most_periods);

/// An element of a random kind on the link.
void add_random_law(Draft &draft, const Link &link);
void add_spring(Draft &draft, const Link &link, double stiffness, double damping_ratio);

/// Switches that turn an element off where a motion passes a value, once or again and again.
void add_switches(Draft &draft);

} // namespace gestell::tests

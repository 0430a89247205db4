#include "apps/scene/language/units.h"

#include "fem/values/nearest_name.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

std::map<std::string, Quantity> make_units()
{
  std::map<std::string, Quantity> table;
  const auto add = [&](const Dimension &dimension, const std::map<std::string, double> &names, Counts counts)
  {
    for (const auto &[name, value] : names)
      table[name] = Quantity{value, dimension, true, counts};
  };
  const Counts none = Counts::nothing;

  add({1, 0, 0},
      {{"m", 1.}, {"km", 1e3}, {"dm", 1e-1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"µm", 1e-6}, {"nm", 1e-9}},
      none);
  add({3, 0, 0}, {{"l", 1e-3}, {"ml", 1e-6}}, none);
  add({1, 0, 0}, {{"in", 0.0254}, {"ft", 0.3048}}, none);
  constexpr double pound = 0.45359237; // [kg]
  add({0, 1, 0}, {{"kg", 1.}, {"g", 1e-3}, {"mg", 1e-6}, {"t", 1e3}, {"lb", pound}}, none);
  add({0, 0, 1}, {{"s", 1.}, {"ms", 1e-3}, {"us", 1e-6}, {"µs", 1e-6}}, none);
  add({0, 0, 1}, {{"min", 60.}, {"h", 3600.}}, Counts::minutes);
  add({1, 1, -2}, {{"N", 1.}, {"mN", 1e-3}, {"daN", 10.}, {"kN", 1e3}, {"MN", 1e6}}, none);
  constexpr double weight_of_kg = 9.80665; // [N] at standard gravity
  add({1, 1, -2}, {{"kp", weight_of_kg}, {"kgf", weight_of_kg}, {"lbf", pound * weight_of_kg}}, none);
  add({2, 1, -2}, {{"Nm", 1.}, {"kNm", 1e3}, {"J", 1.}, {"kJ", 1e3}, {"MJ", 1e6}}, none);
  add({1, 1, -1}, {{"Ns", 1.}, {"kNs", 1e3}}, none);
  add({2, 1, -3}, {{"W", 1.}, {"kW", 1e3}, {"MW", 1e6}, {"PS", 75. * weight_of_kg}}, none);
  add({-1, 1, -2}, {{"Pa", 1.}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}, {"bar", 1e5}, {"mbar", 1e2}}, none);
  add({-1, 1, -2}, {{"psi", pound * weight_of_kg / (0.0254 * 0.0254)}}, none);
  add({0, 0, -1}, {{"Hz", 1.}, {"kHz", 1e3}}, Counts::turns);
  add({0, 0, -1}, {{"rpm", 2. * M_PI / 60.}}, Counts::shaft_turns);
  add({0, 0, 0}, {{"rad", 1.}, {"mrad", 1e-3}, {"deg", M_PI / 180.}, {"°", M_PI / 180.}}, Counts::radians);
  add({0, 0, 0}, {{"%", 1e-2}}, none);
  return table;
}

} // namespace

const std::map<std::string, Quantity> &units()
{
  static const auto table = make_units();
  return table;
}

const std::map<std::string, Quantity> &turn_units()
{
  static const Quantity                        turn{2. * M_PI, {}, true, Counts::shaft_turns};
  static const std::map<std::string, Quantity> table = {{"r", turn}, {"rev", turn}, {"U", turn}};
  return table;
}

std::vector<std::string> unit_names()
{
  std::vector<std::string> names;
  for (const auto &entry : units())
    names.push_back(entry.first);
  return names;
}

std::vector<std::string> units_meant(const std::string &name)
{
  std::vector<std::string> meant;
  for (std::size_t i = 1; i < name.size(); ++i)
  {
    const auto        first = units().find(name.substr(0, i));
    const std::string rest  = name.substr(i);
    if (first != units().end() && (rest == "2" || rest == "3"))
      meant.push_back(first->first + "^" + rest);
    if (const auto second = units().find(rest);
        first != units().end() && second != units().end() && !equal(first->second.dimension, second->second.dimension))
      meant.push_back(first->first + " " + rest);
  }
  const auto near = near_names(name, unit_names());
  meant.insert(meant.end(), near.begin(), near.end());
  return meant;
}

} // namespace gestell::apps

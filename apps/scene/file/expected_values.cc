#include "apps/scene/file/expected_values.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{
namespace
{

/// Plausible range of the values of a key; values outside probably have a wrong unit.
struct Expected
{
  double      least = 0., most = 0.; ///< of the amount, SI
  const char *why = "";              ///< a clause: what sets these limits
};

/// In the SI unit of the kind, if it is in the table below.
std::string with_unit(double value, const Kind &kind)
{
  static const std::map<std::string, std::string> units = {
      {"angle", " rad"},         {"length", " m"},    {"speed", " m/s"},
      {"force", " N"},           {"torque", " N m"},  {"angular speed", " rad/s"},
      {"stiffness", " N/m"},     {"pressure", " Pa"}, {"torsional stiffness", " N m/rad"},
      {"acceleration", " m/s^2"}};
  const auto unit = units.find(kind.name);
  return short_text(value) + (unit == units.end() ? "" : unit->second);
}

/// By the name of the key, or else by its kind.
const Expected *expected_of(const std::string &key, const Kind &kind)
{
  static const Expected                        friction{0., 2., "dry metal has 0.05 to 0.5, rubber on asphalt 1"};
  static const std::map<std::string, Expected> of_keys = {
      {"synchronous_speed", {0., 400., "motors at 50 or 60 Hz mains reach at most 3600 1/min = 377 rad/s"}},
      {"thickness", {1e-6, 0.5, "presses cut sheets up to 60 mm, frames have plates up to 300 mm"}},
      {"shear_resistance", {1e5, 5e9, "sheets from paper to hardened steel have 1 MPa to 2 GPa"}},
      {"bulk_modulus", {1e7, 1e10, "liquids have 0.5 to 3 GPa, with bubbles of air less"}},
      {"ratio of damping", {0., 0.2, "welded and bolted frames have 0.001 to 0.05, rubber up to 0.2"}},
      {"coefficient", friction},
      {"friction", friction}};
  static const std::map<std::string, Expected> of_kinds = {
      {"angle", {0., 4. * M_PI, "angles are given within two turns"}},
      {"length", {0., 200., "parts of machines are shorter"}},
      {"speed", {0., 300., "tools and slides move below the speed of sound in air"}},
      {"angular speed", {0., 3e4, "the fastest spindles turn at 300 000 1/min"}},
      {"force", {0., 2e9, "the largest presses have 1 GN"}},
      {"torque", {0., 1e9, "the largest shafts of ships transmit 10 MN m"}},
      // E a of a cube of steel with edges a = 5 m
      {"stiffness", {0., 1e12, "a solid cube of steel of 5 m has 1e12 N/m"}},
      {"torsional stiffness", {0., 1e13, "a solid shaft of steel of 3 m diameter and length has 2e11 N m/rad"}},
      {"pressure", {100., 1e13, "oil, gas and strength of materials have 100 Pa and more"}}};
  if (const auto own = of_keys.find(key); own != of_keys.end())
    return &own->second;
  const auto found = of_kinds.find(kind.name);
  return found == of_kinds.end() ? nullptr : &found->second;
}

} // namespace

std::string unexpected_words(const std::string &key, const Kind &kind, double value)
{
  const Expected *expected = expected_of(key, kind);
  const double    amount   = std::abs(value);
  if (!expected || amount == 0. || (amount >= expected->least && amount <= expected->most))
    return "";
  const bool large = amount > expected->most;
  return "is " + with_unit(value, kind) + "; expected: at " +
         (large ? "most " + with_unit(expected->most, kind) : "least " + with_unit(expected->least, kind)) + ", as " +
         expected->why + "; check the unit (numbers without a unit are SI)";
}

namespace
{

/// Without the line of the scene.
std::string key_of(const UnexpectedValue &value)
{
  const auto colon = value.place.rfind(": ");
  return colon == std::string::npos ? value.place : value.place.substr(colon + 2);
}

/// "; also unexpected, perhaps for the same reason: element.rod.damping, body.ram"
std::string others(const std::vector<UnexpectedValue> &values, const std::string &warning)
{
  std::vector<std::string> keys;
  for (const UnexpectedValue &value : values)
    if (const std::string key = key_of(value);
        warning.find(key) == std::string::npos && std::find(keys.begin(), keys.end(), key) == keys.end())
      keys.push_back(key);
  std::string           text;
  constexpr std::size_t most_named = 5; // keys of a line of text
  for (std::size_t i = 0; i < std::min(keys.size(), most_named); ++i)
    text += (text.empty() ? "; also unexpected, perhaps for the same reason: " : ", ") + keys[i];
  if (keys.size() > most_named)
    text += " and " + std::to_string(keys.size() - most_named) + " more";
  return text;
}

} // namespace

/// Whether a warning compares a value with an expected range.
bool compares_magnitudes(const std::string &warning)
{
  return warning.find("; expected: ") != std::string::npos;
}

void warn_of_magnitudes(std::vector<UnexpectedValue> found, std::vector<std::string> &warnings)
{
  std::stable_sort(found.begin(), found.end(),
                   [](const UnexpectedValue &a, const UnexpectedValue &b) { return a.excess > b.excess; });
  auto cause = std::find_if(warnings.begin(), warnings.end(), compares_magnitudes);
  if (cause == warnings.end() && !found.empty())
    cause = warnings.insert(warnings.end(), found.front().place + ": " + found.front().words);
  if (cause != warnings.end())
    *cause += others(found, *cause);
}

} // namespace gestell::apps

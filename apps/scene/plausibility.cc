#include "apps/scene/plausibility.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

constexpr double heaviest = 1e7, lightest = 1e-6; // kg: a ship's engine has 2e6
constexpr double farthest = 200.;                 // m
constexpr double widest = 20., narrowest = 1e-4;  // m, radius of gyration
constexpr double most_turns = 2.;                 // of a start

std::string of_body(const BodyRequest &body, const std::string &what)
{
  return body.place + ": body." + body.name + ": " + what;
}

void look_at(const BodyRequest &body, std::vector<std::string> &warnings)
{
  if (body.mass > heaviest || (body.mass > 0. && body.mass < lightest))
    warnings.push_back(of_body(body, "has a mass of " + short_text(body.mass) + " kg, which machines hardly have; " +
                                         "numbers without a unit are in kg, others are written as \"3 t\", \"20 g\""));
  const double arm = body.mass > 0. && body.inertia > 0. ? std::sqrt(body.inertia / body.mass) : 1.;
  if (arm > widest || arm < narrowest)
    warnings.push_back(of_body(body, "has " + short_text(body.inertia) + " kg m^2 with " + short_text(body.mass) +
                                         " kg, a radius of gyration of " + short_text(arm) +
                                         " m; is its inertia in another unit, such as \"40 kg mm^2\"?"));
  const double place = std::hypot(body.position[0], body.position[1], body.position[2]);
  if (place > farthest)
    warnings.push_back(of_body(body, "lies " + short_text(place) +
                                         " m from the origin; numbers without a unit are in "
                                         "m, others are written as \"850 mm\""));
}

bool turns(const Scene &scene, const std::string &coordinate)
{
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const BodyRequest &body)
                     { return body.name == coordinate && body.kind == coupling::BodyKind::rotor; });
}

} // namespace

std::vector<std::string> implausible_numbers(const Scene &scene)
{
  std::vector<std::string> warnings;
  for (const BodyRequest &body : scene.bodies)
    look_at(body, warnings);
  for (const NamedValue &angle : scene.start.q)
    if (turns(scene, angle.name) && std::abs(angle.value) > 2. * M_PI * most_turns)
      warnings.push_back(angle.place + ": start.q." + angle.name + ": is " + short_text(angle.value) + " rad, " +
                         short_text(angle.value / (2. * M_PI)) +
                         " turns; numbers without a unit are in rad, others are written as \"120 deg\"");
  const auto  &g      = scene.gravity;
  const double amount = std::hypot(g[0], g[1], g[2]);
  if (g[2] > 0.9 * amount && amount > 1.)
    warnings.push_back(scene.file + ":1: gravity: acts upwards, along +z, with " + short_text(g[2]) +
                       " m/s^2; where z points up it is [0, 0, \"-9.81 m/s^2\"]");
  return warnings;
}

} // namespace gestell::apps

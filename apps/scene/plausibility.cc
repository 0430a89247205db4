#include "apps/scene/plausibility.h"

#include "apps/scene/file/unexpected_values.h"
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

using Unexpected = std::vector<UnexpectedValue>;

void look_at(const BodyRequest &body, Unexpected &found)
{
  if (body.mass > heaviest || (body.mass > 0. && body.mass < lightest))
    found.push_back({body.place,
                     "has a mass of " + short_text(body.mass) + " kg; expected: " + short_text(lightest) + " kg to " +
                         short_text(heaviest) +
                         " kg; numbers without a unit are in kg, others are written as \"3 t\", \"20 g\"",
                     std::max(body.mass / heaviest, lightest / body.mass)});
  const double arm = body.mass > 0. && body.inertia > 0. ? std::sqrt(body.inertia / body.mass) : 1.;
  if (arm > widest || arm < narrowest)
    found.push_back({body.place,
                     "has " + short_text(body.inertia) + " kg m^2 with " + short_text(body.mass) +
                         " kg, a radius of gyration of " + short_text(arm) + " m; expected: " + short_text(narrowest) +
                         " m to " + short_text(widest) +
                         " m; is its mass or inertia in another unit, such as \"40 kg mm^2\"?",
                     std::max(arm / widest, narrowest / arm)});
  const double place = std::hypot(body.position[0], body.position[1], body.position[2]);
  if (place > farthest)
    found.push_back({body.place,
                     "lies " + short_text(place) + " m from the origin; expected: at most " + short_text(farthest) +
                         " m; numbers without a unit are in m, others are written as \"850 mm\"",
                     place / farthest});
}

bool turns(const Scene &scene, const std::string &coordinate)
{
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [&](const BodyRequest &body)
                     { return body.name == coordinate && body.kind == coupling::BodyKind::rotor; });
}

} // namespace

void warn_of_implausible_numbers(Scene &scene)
{
  Unexpected found;
  for (const BodyRequest &body : scene.bodies)
    look_at(body, found);
  for (const NamedValue &angle : scene.start.q)
    if (const double turned = std::abs(angle.value) / (2. * M_PI); turns(scene, angle.name) && turned > most_turns)
      found.push_back({angle.place,
                       "is " + short_text(angle.value) + " rad, " + short_text(turned) + " turns; expected: at most " +
                           short_text(most_turns) +
                           " turns; numbers without a unit are in rad, others are written as \"120 deg\"",
                       turned / most_turns});
  warn_of_magnitudes(std::move(found), scene.warnings);
  const auto  &g      = scene.gravity;
  const double amount = std::hypot(g[0], g[1], g[2]);
  if (g[2] > 0.9 * amount && amount > 1.)
    scene.warnings.push_back(scene.file + ":1: gravity: acts upwards, along +z, with " + short_text(g[2]) +
                             " m/s^2; where z points up it is [0, 0, \"-9.81 m/s^2\"]");
}

} // namespace gestell::apps

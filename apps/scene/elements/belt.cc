#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_wheels.h"
#include "fem/values/number_text.h"
#include "mechanism/elements/common_tangents.h"

#include <cmath>
#include <optional>

namespace gestell::apps
{
namespace
{

using mechanism::Belt;

/// A belt or chain around two wheels, in the initial configuration.
struct Loop
{
  double from = 0., to = 0.; ///< radii [m]; `to` negative: crossed
  double distance = 0.;      ///< of the centres [m]

  double circles() const { return from - to; }
  double strand() const { return std::sqrt(distance * distance - circles() * circles()); }
  /// 2 l + pi (r_1 + |r_2|) + 2 gamma (r_1 - r_2),  sin(gamma) = (r_1 - r_2)/D
  double path() const
  {
    return 2. * strand() + M_PI * (from + std::abs(to)) + 2. * std::asin(circles() / distance) * circles();
  }
};

Loop loop_around(const SceneTable &table, double from, double to, double distance)
{
  if (!(from + std::abs(to) < distance))
    throw table.error("wheels of radius " + short_text(from) + " m and " + short_text(std::abs(to)) +
                      " m overlap: their centres are " + short_text(distance) +
                      " m apart, less than the sum of the radii; correct 'at_from', 'at_to' or the radii");
  return {from, to, distance};
}

/// Stiffness of one strand: given, or EA/l of its free length.
double strand_stiffness(const SceneTable &table, const Loop &loop)
{
  if (table.has("stiffness") == table.has("rigidity"))
    throw table.error("needs either 'stiffness' of one strand or 'rigidity' E A");
  return table.has("stiffness") ? table.value("stiffness") : table.value("rigidity") / loop.strand();
}

/// What a loop of given length may have.
struct LoopLimits
{
  std::string key;            ///< that gives the length
  double      usual, largest; ///< strain: beyond the first a warning, beyond the second an error
  double      slack;          ///< [m] that its mounting leaves; beyond: a warning
};

/// Elongation of both strands [m] of a loop that has the length `length` without force.
double elongation_by(const SceneTable &table, const Loop &loop, double length, const LoopLimits &limits)
{
  const double      strain = (loop.path() - length) / length;
  const std::string way    = "is " + short_text(length, 6) +
                          " m long, but its path around both wheels at a centre distance of " +
                          short_text(loop.distance, 6) + " m is " + short_text(loop.path(), 6) + " m: ";
  if (strain > limits.largest)
    throw table.error(way + "it would be stretched by " + percent(strain) + ", at most " + percent(limits.largest) +
                      " is plausible; use a longer one or move the wheels together");
  if (strain > limits.usual)
    table.warn(limits.key, way + "it is stretched by " + percent(strain) + " at the start, more than the usual " +
                               percent(limits.usual) + "; check length and centres");
  if (length - loop.path() > limits.slack)
    table.warn(limits.key, way + "both strands are slack at the start, by " +
                               short_text(0.5 * (length - loop.path()), 3) +
                               " m each, and the wheels rotate freely until one is taut; check length and centres");
  return strain > 0. ? strain * loop.strand() : 0.5 * (loop.path() - length);
}

void add_loop(const SceneTable &table, Scene &scene, const WheelPair &wheels, const Loop &loop,
              const std::optional<double> &length, const LoopLimits &limits)
{
  Belt::Parameters belt;
  belt.stiffness = strand_stiffness(table, loop);
  belt.damping   = table.value("damping");
  belt.circles   = loop.circles();
  belt.distance  = loop.distance;
  belt.initial =
      length ? elongation_by(table, loop, *length, limits) : table.value_or("pretension", 0.) / belt.stiffness;
  TangentsRequest strands;
  strands.first  = loop.from;
  strands.second = loop.to;
  add_on_tangents(scene, table, checked(table, [&] { return std::make_shared<Belt>(belt); }), wheels, strands);
}

void read_belt(const SceneTable &table, const Names &names, Scene &scene)
{
  if (table.has("pretension") == table.has("length"))
    throw table.error(
        "needs either 'pretension', the tension of both strands at rest, or 'length' of the unloaded belt");
  const WheelPair wheels = read_wheels(table, names, "pulley");
  const double    to     = table.value("radius_to");
  // Belts that hold by their stretch alone are mounted with up to 5 %, beyond which E A is not constant; those with
  // cords below 1 %.
  add_loop(table, scene, wheels,
           loop_around(table, table.value("radius_from"), table.truth("crossed") ? -to : to, wheels.distance),
           table.has("length") ? std::optional(table.value("length")) : std::nullopt, {"length", 0.01, 0.05, 0.});
}

/// Mean radius, z p/(2 pi): on average a sprocket carries z links in a turn.
double sprocket(const SceneTable &table, const std::string &key)
{
  const int teeth = table.whole(key);
  if (teeth < 5)
    throw table.error(key, "is " + std::to_string(teeth) + "; a sprocket has at least 5 teeth");
  return teeth * table.value("pitch") / (2. * M_PI);
}

/// Length of the chain by its links.
std::optional<double> read_links(const SceneTable &table)
{
  if (!table.has("links"))
    return std::nullopt;
  const int links = table.whole("links");
  if (links < 1)
    throw table.error("links", "is " + std::to_string(links) + "; the path of the chain needs more links");
  return links * table.value("pitch");
}

void read_chain(const SceneTable &table, const Names &names, Scene &scene)
{
  if (table.has("pretension") && table.has("links"))
    throw table.error("has both 'pretension' and 'links', which fix the same length; give only one");
  const WheelPair wheels = read_wheels(table, names, "sprocket");
  // Steel yields before half a percent; a chain, mounted without pull, comes in pairs of links.
  add_loop(table, scene, wheels,
           loop_around(table, sprocket(table, "teeth_from"), sprocket(table, "teeth_to"), wheels.distance),
           read_links(table), {"links", 0.001, 0.005, 2. * table.value("pitch")});
}

std::vector<Key> strand_keys()
{
  return {key::number("stiffness", kind::stiffness, "stiffness of one strand").above_zero().by_default("`rigidity`"),
          key::number("rigidity", kind::force,
                      "axial rigidity E A: a strand of free length l (initial configuration) has the stiffness E A/l")
              .above_zero()
              .by_default("`stiffness`"),
          key::number("damping", kind::damping, "damping of a taut strand").from_zero().by_default(0.)};
}

constexpr const char *loop_signals =
    "`left_force`, `right_force` of the strands; `hub_force` on either shaft, the magnitude of their vector sum";

} // namespace

ElementType belt_type()
{
  return {
      "belt",
      "Belt around two pulleys, without slip. Each strand is a spring between its tangent points that only pulls. "
      "Events: `left_slack`, `left_taut`, with damping also `left_relaxed` at the free length; the same for `right`.",
      loop_signals,
      joined(
          {wheel_keys("pulley"),
           {key::number("radius_from", kind::length, "radius of the pulley on `from`, to the neutral line of the belt")
                .above_zero(),
            key::number("radius_to", kind::length, "radius of the pulley on `to`").above_zero(),
            key::truth("crossed", false, "crossed strands: the pulleys turn in opposite senses")},
           strand_keys(),
           {key::number("pretension", kind::force, "tension of each strand in the initial configuration")
                .from_zero()
                .by_default("by `length`"),
            key::number("length", kind::length,
                        "length of the unloaded belt; if longer than its path, the belt is slack")
                .above_zero()
                .by_default("by `pretension`")}}),
      read_belt,
      {wheel_example() + R"toml(radius_from = "60 mm"
radius_to   = "150 mm"
rigidity    = "120 kN"
damping     = "20 N s/m"
pretension  = "400 N"
)toml",
       wheel_example() + R"toml(radius_from = "60 mm"
radius_to   = "150 mm"
crossed     = true
stiffness   = "200 N/mm"
length      = "1.93 m"
)toml"}};
}

ElementType chain_type()
{
  return {"chain",
          "Chain around two sprockets: as a belt with the mean radii of the sprockets, by default without pretension.",
          loop_signals,
          joined({wheel_keys("sprocket"),
                  {key::number("pitch", kind::length, "pitch of the chain").above_zero(),
                   key::plain("teeth_from", Key::Form::whole, "number of teeth of the sprocket on `from`, 5 or more"),
                   key::plain("teeth_to", Key::Form::whole, "number of teeth of the sprocket on `to`, 5 or more")},
                  strand_keys(),
                  {key::number("pretension", kind::force, "tension of each strand in the initial configuration")
                       .from_zero()
                       .by_default("0, or by `links`"),
                   key::plain("links", Key::Form::whole, "number of links, instead of `pretension`").by_default("")}}),
          read_chain,
          {wheel_example() + R"toml(pitch       = "12.7 mm"
teeth_from  = 17
teeth_to    = 38
rigidity    = "2 MN"
damping     = "50 N s/m"
pretension  = "50 N"
)toml",
           wheel_example() + R"toml(pitch       = "12.7 mm"
teeth_from  = 17
teeth_to    = 38
stiffness   = "3 kN/mm"
links       = 124
)toml"}};
}

} // namespace gestell::apps

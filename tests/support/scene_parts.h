#pragma once

#include "tests/support/scene_text.h"

#include <cstdlib>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace gestell::tests
{

/// Tables of scenes, as many tests need the same.  Values stand as in a scene but for their quotes: "2 kg", "0.5",
/// "[0, 0, '1 m']", whose single quotes become those of scenes; `more` are further keys.
using Keys = std::vector<std::pair<std::string, std::string>>;

/// A number with all its digits, and three of them.
inline std::string number(double x)
{
  std::ostringstream text;
  text.precision(17);
  text << x;
  return text.str();
}

inline std::string vector(double x, double y, double z)
{
  return '[' + number(x) + ", " + number(y) + ", " + number(z) + ']';
}

/// The line of a key: a number, an array or a table stands as it is, all else in quotes.
inline std::string line(const std::string &key, const std::string &value)
{
  char *end = nullptr;
  std::strtod(value.c_str(), &end);
  const bool plain = value[0] == '[' || value[0] == '{' || *end == '\0' || value == "true" || value == "false";
  return key + " = " + (plain ? test::quoted(value) : '"' + value + '"') + '\n';
}

inline std::string table(const std::string &name, const Keys &keys, const Keys &more = {})
{
  std::string text = '[' + name + "]\n";
  for (const Keys *some : {&keys, &more})
    for (const auto &[key, value] : *some)
      text += line(key, value);
  return text;
}

/// [kind.name] of a type, with what else it needs.
inline std::string typed(const std::string &kind, const std::string &name, const std::string &type, Keys keys)
{
  keys.insert(keys.begin(), {"type", type});
  return table(kind + '.' + name, keys);
}

inline std::string planar_body(const std::string &name, const std::string &mass, const std::string &inertia,
                               const std::string &position, const std::string &normal = "[0, 1, 0]")
{
  return table("body." + name,
               {{"type", "planar"}, {"normal", normal}, {"mass", mass}, {"inertia", inertia}, {"position", position}});
}

inline std::string rigid_body(const std::string &name, const std::string &mass, const std::string &inertia,
                              const std::string &position, const Keys &more = {})
{
  return table("body." + name, {{"type", "rigid"}, {"mass", mass}, {"inertia", inertia}, {"position", position}}, more);
}

inline std::string point_body(const std::string &name, const std::string &mass, const std::string &position)
{
  return table("body." + name, {{"type", "point"}, {"mass", mass}, {"position", position}});
}

inline std::string rotor_body(const std::string &name, const std::string &inertia, const std::string &axis,
                              const Keys &more = {})
{
  return table("body." + name, {{"type", "rotor"}, {"axis", axis}, {"inertia", inertia}}, more);
}

inline std::string slider_body(const std::string &name, const std::string &mass, const std::string &axis,
                               const Keys &more = {})
{
  return table("body." + name, {{"type", "slider"}, {"axis", axis}, {"mass", mass}}, more);
}

inline std::string joint(const std::string &name, const std::string &type, const Keys &keys)
{
  return typed("joint", name, type, keys);
}

inline std::string joint(const std::string &name, const std::string &type, const std::string &from,
                         const std::string &to, const std::string &at, const Keys &more = {})
{
  return table("joint." + name, {{"type", type}, {"from", from}, {"to", to}, {"at", at}}, more);
}

inline std::string revolute(const std::string &name, const std::string &from, const std::string &to,
                            const std::string &at, const Keys &more = {})
{
  return joint(name, "revolute", from, to, at, more);
}

inline std::string element(const std::string &name, const std::string &type, const Keys &keys)
{
  return typed("element", name, type, keys);
}

inline std::string measure(const std::string &name, const std::string &type, const Keys &keys)
{
  return typed("measure", name, type, keys);
}

inline std::string place(const std::string &name, const std::string &on, const std::string &at)
{
  return table("place." + name, {{"on", on}, {"at", at}});
}

/// Three masses of 100 kg one above the other on springs of 1 kN/mm, the topmost an interface; all on the ground by
/// what the stiffness of the lowest is above 1e6.
inline std::string mass_chain(const std::string &lowest = "2e6")
{
  return "gravity = [0, 0, -9.81]\n" +
         table("frame", {{"mass", "[[100, 0, 0], [0, 100, 0], [0, 0, 100]]"},
                         {"stiffness", "[[" + lowest + ", -1e6, 0], [-1e6, 2e6, -1e6], [0, -1e6, 1e6]]"},
                         {"translations", "[[0, 0, 1], [0, 0, 1], [0, 0, 1]]"}}) +
         table("frame.interface.top", {{"rows", "{ uz = 3 }"}});
}

/// A plane surface of a frame from CAD.
inline std::string plane_surface(const std::string &name, const std::string &normal, const std::string &through)
{
  return table("frame.surface." + name, {{"plane", "{ normal = " + normal + ", through = " + through + " }"}});
}

/// A steel frame drawn in metres.
inline std::string cad_frame(const std::string &file, const std::string &mesh_size, const Keys &more = {})
{
  return table("frame",
               {{"cad", file}, {"unit", "1 m"}, {"mesh", "{ size = '" + mesh_size + "' }"}, {"material", "steel"}},
               more);
}

/// @param state  lines such as `v = { slide = '1 m/s' }`
inline std::string start(const std::string &state)
{
  return "[start]\n" + test::quoted(state) + '\n';
}

/// Steps [run] up to an end.
inline std::string steps(const std::string &step, const std::string &end, const Keys &more = {})
{
  return table("run", {{"step", step}, {"end", end}}, more);
}

/// A history of these signals, without pictures: `x = 'slide.displacement', ...`.
inline std::string signals(const std::string &list, const Keys &more = {})
{
  return table("output", {{"picture_step", "0"}}, more) + "signals = { " + test::quoted(list) + " }\n";
}

} // namespace gestell::tests

#include "apps/scene/read/read_motion.h"

#include "apps/scene/read/checked.h"
#include "apps/scene/read/read_function.h"
#include "apps/scene/read/read_profile.h"

namespace gestell::apps
{
namespace
{

/// Speed that is constant until a switch brakes it, or a profile.
std::shared_ptr<const mechanism::MotionLaw> read_speed(const SceneTable &table, bool turns)
{
  using mechanism::BrakedMotion;
  const ProfileKeys keys  = turns ? speed_profile() : path_profile();
  const auto        brake = table.optional_table("brake");
  if (table.is_array("speed") || !brake)
  {
    const double from =
        table.is_array("speed") || table.has("waits") ? table.number("initial_speed", keys.level, 0.) : 0.;
    const auto speed = read_course(table, "speed", keys, from);
    return checked(table, [&] { return std::make_shared<mechanism::ProfileMotion>(speed); });
  }
  BrakedMotion::Parameters motion;
  motion.speed             = table.number("speed", keys.level);
  const std::string family = brake->choice("family", {"linear", "cosine", "shaped"}, "linear");
  motion.family            = family == "linear"   ? BrakedMotion::Family::linear
                             : family == "cosine" ? BrakedMotion::Family::cosine
                                                  : BrakedMotion::Family::shaped;
  motion.duration          = brake->positive("duration", kind::time);
  if (family == "shaped")
    for (const auto &ramp : brake->table_array("ramps"))
      motion.ramps.push_back({ramp.number("share", kind::number), ramp.not_negative("delay", kind::time, 0.)});
  return checked(*brake, [&] { return std::make_shared<BrakedMotion>(motion); });
}

} // namespace

std::shared_ptr<const mechanism::MotionLaw> read_motion(const SceneTable &table, bool turns)
{
  if (table.has("speed") && (table.has("function") || table.has("table")))
    throw table.error("speed", "says the same as 'function' or 'table'; give one of them");
  if (table.has("speed"))
    return read_speed(table, turns);
  if (!table.has("function") && !table.has("table"))
    throw table.error("needs 'speed', or 'function', a formula of the time t, or 'table'");
  const auto f =
      read_function(table, {"t", "time", kind::time.dimension}, kind::time, turns ? kind::angle : kind::length);
  refuse_jumps(table, *f, kind::time);
  return std::make_shared<mechanism::FunctionMotion>(*f);
}

} // namespace gestell::apps

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
    const double from  = table.is_array("speed") || table.has("waits") ? table.value("initial_speed", turns) : 0.;
    const auto   speed = read_course(table, "speed", keys, from);
    return checked(table, [&] { return std::make_shared<mechanism::ProfileMotion>(speed); });
  }
  BrakedMotion::Parameters motion;
  motion.speed             = table.number("speed", keys.level);
  const std::string family = brake->choice("family");
  motion.family            = family == "linear"   ? BrakedMotion::Family::linear
                             : family == "cosine" ? BrakedMotion::Family::cosine
                                                  : BrakedMotion::Family::shaped;
  motion.duration          = brake->value("duration");
  if (family == "shaped")
    for (const auto &ramp : brake->table_array("ramps"))
      motion.ramps.push_back({ramp.value("share"), ramp.value("delay")});
  return checked(*brake, [&] { return std::make_shared<BrakedMotion>(motion); });
}

} // namespace

std::vector<Key> motion_law_keys()
{
  const std::string speed = "constant speed until the command `brake` of a [switch](switches.md#switches), if there is "
                            "one, or [ramps](elements.md#profiles) with `acceleration` and `jerk`";
  return joined(
      {{profile_key("speed", path_profile(), speed)
            .on_angle(profile_key("speed", speed_profile(), speed))
            .by_default("`function` or `table`"),
        key::number("initial_speed", kind::speed, "speed before the first ramp")
            .on_angle(kind::angular_speed)
            .by_default(0.),
        waits_key(),
        key::table(
            "brake",
            {key::choice("family", {"linear", "cosine", "shaped"}, true, "profile of the speed to zero"),
             key::number("duration", kind::time, "duration of braking, or of each ramp").above_zero(),
             key::composed("ramps", Key::Form::tables, kind::number,
                           {key::number("share", kind::number, "share of the speed"),
                            key::number("delay", kind::time, "delay after the command").from_zero().by_default(0.)},
                           "ramps of `\"shaped\"`")
                 .by_default("none")},
            "braking: `{ family = \"linear\", duration = \"0.15 s\" }` reduces the speed to zero at constant "
            "deceleration, `\"cosine\"` along half a cosine, `\"shaped\"` in ramps of this duration each, `ramps = [{ "
            "share = 0.5, delay = 0 }, { share = 0.5, delay = \"1.2 s\" }]`. Corners are events, the last one "
            "`braking_ends`")
            .by_default("none")},
       function_keys(kind::time, kind::length)});
}

std::shared_ptr<const mechanism::MotionLaw> read_motion(const SceneTable &table, bool turns)
{
  if (table.has("speed") && (table.has("function") || table.has("table")))
    throw table.error("speed", "means the same as 'function' or 'table'; give only one of them");
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

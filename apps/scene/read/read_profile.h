#pragma once

#include "apps/scene/file/scene_table.h"
#include "mechanism/functions/commanded_profile.h"
#include "mechanism/functions/input_value.h"

#include <memory>

namespace gestell::apps
{

/// How a profile is written: the kinds of its level and of its limits, and what these are called.
struct ProfileKeys
{
  Kind        level;
  Kind        rate, rate_of_rate;
  std::string rate_key = "rate", rate_of_rate_key = "rate_of_rate"; ///< of a speed "acceleration" and "jerk"
};

ProfileKeys speed_profile();                                       ///< of a rotor: rad/s
ProfileKeys path_profile();                                        ///< of a motion along a path: m/s
ProfileKeys level_profile(const Kind &level, const std::string &); ///< `rate` and `rate_of_rate` of anything else

/// The key of a profile; `waits` goes with it.
Key profile_key(const std::string &name, const ProfileKeys &keys, const std::string &meaning);
/// The same that may be a function of time.
Key course_key(const std::string &name, const ProfileKeys &keys, const std::string &meaning);
Key waits_key();

/**
 * Reads the ramps [{ at = "1 s", to = "1500 1/min", acceleration = "200 rad/s^2", jerk = "1000 rad/s^3" }] of `key`; a
 * level alone, speed = "1500 1/min", is constant.
 *
 * @param from  level before the first ramp
 */
mechanism::Profile read_profile(const SceneTable &table, const std::string &key, const ProfileKeys &keys, double from);

/// As read_profile(); with `waits` the course stays at the level `from` until the order "start".
mechanism::CommandedProfile read_course(const SceneTable &table, const std::string &key, const ProfileKeys &keys,
                                        double from);

/// As read_course(); besides a formula of the time t, or a table { function = ... } or { table = ... } of it.
mechanism::CommandedProfile read_free_course(const SceneTable &table, const std::string &key, const ProfileKeys &keys,
                                             double from);

/// The key of a course that may be an input as well.
Key or_input(Key course);
/// Reads { input = "NAME" } of a course, which is at `from` until it is set from outside; null if it is no input.
std::shared_ptr<mechanism::InputValue> read_input(const SceneTable &table, const std::string &key, double from);

} // namespace gestell::apps

#pragma once

#include "apps/scene/file/scene_table.h"
#include "mechanism/functions/commanded_profile.h"
#include "mechanism/functions/input_value.h"

#include <memory>

namespace gestell::apps
{

/// Notation of a profile: the kinds of its level and of its limits, and the names of their keys.
struct ProfileKeys
{
  Kind        level;
  Kind        rate, rate_of_rate;
  std::string rate_key = "rate", rate_of_rate_key = "rate_of_rate"; ///< for a speed "acceleration" and "jerk"
};

ProfileKeys speed_profile();                                       ///< of a rotor: rad/s
ProfileKeys path_profile();                                        ///< of a motion along a path: m/s
ProfileKeys level_profile(const Kind &level, const std::string &); ///< `rate` and `rate_of_rate` of any other quantity

/// The key of a profile; used together with `waits`.
Key profile_key(const std::string &name, const ProfileKeys &keys, const std::string &meaning);
/// The same for a profile that may also be a function of time.
Key course_key(const std::string &name, const ProfileKeys &keys, const std::string &meaning);
Key waits_key();

/**
 * Reads the ramps [{ at = "1 s", to = "1500 1/min", acceleration = "200 rad/s^2", jerk = "1000 rad/s^3" }] of `key`; a
 * level alone, speed = "1500 1/min", is constant.
 *
 * @param from  level before the first ramp
 */
mechanism::Profile read_profile(const SceneTable &table, const std::string &key, const ProfileKeys &keys, double from);

/// Like read_profile(); with `waits` the profile stays at the level `from` until the command "start".
mechanism::CommandedProfile read_course(const SceneTable &table, const std::string &key, const ProfileKeys &keys,
                                        double from);

/// Like read_course(); it may also be a formula of the time t, or a table { function = ... } or { table = ... } of t.
mechanism::CommandedProfile read_free_course(const SceneTable &table, const std::string &key, const ProfileKeys &keys,
                                             double from);

/// The key of a profile that may also be an input.
Key or_input(Key course);
/// Reads { input = "NAME" } of a profile, whose value is `from` until it is set from outside; null: not an input.
std::shared_ptr<mechanism::InputValue> read_input(const SceneTable &table, const std::string &key, double from);

} // namespace gestell::apps

#include "apps/scene/read/read_profile.h"

#include "apps/scene/file/scene_table.h"
#include "apps/scene/read/read_function.h"
#include "mechanism/functions/input_value.h"

#include <memory>

namespace gestell::apps
{
namespace
{

Kind per_seconds(const Kind &level, const std::string &name, const std::string &example, int n)
{
  Kind kind{name, example, level.dimension, level.refused};
  kind.dimension[2] -= n;
  return kind;
}

} // namespace

ProfileKeys speed_profile()
{
  const Kind &speed = kind::angular_speed;
  return {speed, per_seconds(speed, "angular acceleration", "200 rad/s^2", 1),
          per_seconds(speed, "rate of an angular acceleration", "1000 rad/s^3", 2), "acceleration", "jerk"};
}

ProfileKeys path_profile()
{
  ProfileKeys keys      = level_profile(kind::speed, kind::speed.example);
  keys.rate_key         = "acceleration";
  keys.rate_of_rate_key = "jerk";
  return keys;
}

ProfileKeys level_profile(const Kind &level, const std::string &example)
{
  return {level, per_seconds(level, level.name + " per second", example + "/s", 1),
          per_seconds(level, level.name + " per second squared", example + "/s^2", 2)};
}

Key profile_key(const std::string &name, const ProfileKeys &keys, const std::string &meaning)
{
  return key::composed(
      name, Key::Form::profile, keys.level,
      {key::number("at", kind::time, "start of the ramp, not before the end of the previous ramp"),
       key::number("to", keys.level, "level at the end of the ramp"),
       key::number(keys.rate_key, keys.rate, "largest rate of change").above_zero().by_default("a jump"),
       key::number(keys.rate_of_rate_key, keys.rate_of_rate, "largest rate of change of the rate")
           .above_zero()
           .by_default("corners")},
      meaning);
}

Key course_key(const std::string &name, const ProfileKeys &keys, const std::string &meaning)
{
  Key course  = profile_key(name, keys, meaning);
  course.form = Key::Form::course;
  course.keys = joined({course.keys, function_keys(kind::time, keys.level)});
  return course;
}

Key waits_key()
{
  return key::truth("waits", false, "wait at the initial level until a switch sends \"start\"");
}

mechanism::Profile read_profile(const SceneTable &table, const std::string &key, const ProfileKeys &keys, double from)
{
  if (!table.is_array(key))
    return table.number(key, keys.level);
  std::vector<mechanism::Profile::Ramp> ramps;
  for (const auto &part : table.table_array(key))
  {
    mechanism::Profile::Ramp ramp;
    ramp.at           = part.number("at", kind::time);
    ramp.to           = part.number("to", keys.level);
    ramp.rate         = part.positive(keys.rate_key, keys.rate, ramp.rate);
    ramp.rate_of_rate = part.positive(keys.rate_of_rate_key, keys.rate_of_rate, ramp.rate_of_rate);
    ramps.push_back(ramp);
  }
  if (ramps.empty())
    throw table.error(key, "is an empty array; give a level, or ramps such as { at = \"0 s\", to = ... }");
  try
  {
    return mechanism::Profile("profile", from, ramps);
  }
  catch (const std::invalid_argument &e)
  {
    throw table.error(key, e.what());
  }
}

namespace
{

mechanism::CommandedProfile begun(const SceneTable &table, const mechanism::CommandedProfile &course, double from)
{
  return table.boolean("waits", false) ? course.waiting(from) : course;
}

} // namespace

mechanism::CommandedProfile read_course(const SceneTable &table, const std::string &key, const ProfileKeys &keys,
                                        double from)
{
  return begun(table, read_profile(table, key, keys, from), from);
}

mechanism::CommandedProfile read_free_course(const SceneTable &table, const std::string &key, const ProfileKeys &keys,
                                             double from)
{
  using mechanism::CommandedProfile;
  const Variable t{"t", "time", kind::time.dimension};
  if (table.is_array(key))
    return read_course(table, key, keys, from);
  if (table.is_table(key))
    return begun(table, CommandedProfile(*read_function(table.table(key), t, kind::time, keys.level)), from);
  const auto formula = table.formula(key, {t}, keys.level);
  if (formula.is_constant())
    return begun(table, formula.constant(), from);
  return begun(table, CommandedProfile(mechanism::PositionFunction(formula)), from);
}

Key or_input(Key course)
{
  course.keys.push_back(key::plain("input", Key::Form::text,
                                   "name of an input for [other programs](../../how_to/fmu.md); without co-simulation "
                                   "it stays at the initial level")
                            .by_default("none"));
  return course;
}

std::shared_ptr<mechanism::InputValue> read_input(const SceneTable &table, const std::string &key, double from)
{
  if (!table.is_table(key) || !table.table(key).has("input"))
    return nullptr;
  const SceneTable  course = table.table(key);
  const std::string name   = course.text("input");
  if (name.empty() || name.find_first_of("\"<>&\n\t") != std::string::npos)
    throw course.error("input", "is '" + name + "'; an input needs a name without quotes, <, > and &");
  for (const std::string &other : course.keys())
    if (other != "input")
      throw course.error(other, "has no effect on an input, whose value is set from outside; remove '" + other +
                                    "' or 'input'");
  if (table.boolean("waits", false))
    throw table.error("waits", "has no effect on an input, whose value is set from outside; remove it");
  return std::make_shared<mechanism::InputValue>(mechanism::InputValue{name, from, 0., 0.});
}

} // namespace gestell::apps

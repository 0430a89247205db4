#include "apps/scene/read/read_profile.h"

#include "apps/scene/read/read_function.h"

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
      {key::number("at", kind::time, "beginning of the ramp, not before the end of the ramp before it"),
       key::number("to", keys.level, "level at its end"),
       key::number(keys.rate_key, keys.rate, "largest rate").above_zero().by_default("a jump"),
       key::number(keys.rate_of_rate_key, keys.rate_of_rate, "largest rate of the rate")
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
  return key::truth("waits", false, "stays at its first level until a switch tells it \"start\"");
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

} // namespace gestell::apps

#include "apps/scene/read/read_input.h"

namespace gestell::apps
{

Key or_input(Key course)
{
  course.keys.push_back(key::plain("input", Key::Form::text,
                                   "name of an input that [other programs](../fmu.md) set; by itself it stays at the "
                                   "initial level")
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
      throw course.error(other, "is of no meaning for an input, which follows what sets it; leave out '" + other +
                                    "' or 'input'");
  if (table.boolean("waits", false))
    throw table.error("waits", "is of no meaning for an input, which follows what sets it; leave it out");
  return std::make_shared<mechanism::InputValue>(mechanism::InputValue{name, from, 0., 0.});
}

} // namespace gestell::apps

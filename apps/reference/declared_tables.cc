#include "apps/reference/declared_tables.h"

#include "apps/scene/elements/element_types.h"
#include "apps/scene/read/read_contact.h"
#include "apps/scene/read/relative_motion.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

std::vector<DeclaredTable> make_tables()
{
  std::vector<DeclaredTable> tables;
  tables.push_back(
      {"element", "What every [element.NAME] has, beside the keys of its type.", "", common_element_keys(), {}});
  for (const ElementType &type : element_types())
    tables.push_back({"element." + type.name, type.does, type.signals, type.keys, type.examples});
  return tables;
}

std::string unit_of(const Kind &kind)
{
  if (equal(kind.dimension, kind::frequency.dimension))
    return kind.refused == Counts::radians ? "[Hz]" : "[rad/s]";
  if (equal(kind.dimension, {}))
    return kind.refused == Counts::turns ? "[rad]" : "";
  return "[" + describe(kind.dimension) + "]";
}

std::string kind_text(const Kind &kind)
{
  const std::string unit = unit_of(kind);
  return kind.name + (unit.empty() ? "" : " " + unit);
}

std::string names_of(const std::vector<Key> &keys)
{
  std::string names;
  for (const Key &key : keys)
    names += (names.empty() ? "" : ", ") + key.name;
  return names;
}

std::string range_text(Key::Range range)
{
  switch (range)
  {
  case Key::Range::above_zero:
    return ", above 0";
  case Key::Range::from_zero:
    return ", 0 or more";
  case Key::Range::share:
    return ", above 0, at most 1";
  case Key::Range::any:
    break;
  }
  return "";
}

std::string form_text(const Key &key, const std::string &kinds)
{
  switch (key.form)
  {
  case Key::Form::number:
    return kinds;
  case Key::Form::formula:
    return "formula of " + kinds;
  case Key::Form::profile:
  case Key::Form::course:
    return kinds + ", or ramps" + (key.form == Key::Form::course ? ", or a function" : "") + " of " +
           names_of(key.keys);
  case Key::Form::truth:
    return "true or false";
  case Key::Form::choice:
    return "one of " + listed(key.choices);
  case Key::Form::name:
    return "name";
  case Key::Form::direction:
    return "direction [x, y, z]";
  case Key::Form::vector:
    return "three of " + kinds;
  case Key::Form::rows:
    return "rows of two values, the second " + kinds;
  case Key::Form::tables:
    return "array of tables of " + names_of(key.keys);
  case Key::Form::coefficient:
    return kinds + ", or a table of " + names_of(key.keys);
  }
  return "";
}

} // namespace

const std::vector<DeclaredTable> &declared_tables()
{
  static const std::vector<DeclaredTable> tables = make_tables();
  return tables;
}

const std::vector<KeyGroup> &key_groups()
{
  static const std::vector<KeyGroup> groups = {
      {"Motion of an element", load_motion_keys()},
      {"Shaft of a motor", shaft_keys()},
      {"Stiffness of a contact", joined({contact_keys(), {sliding_friction_key()}})}};
  return groups;
}

std::string taken_by(const Key &key)
{
  const std::string angular = key.angular ? ", about an axis " + kind_text(*key.angular) : "";
  return form_text(key, kind_text(key.kind) + angular) + range_text(key.range);
}

std::string default_of(const Key &key)
{
  if (key.demanded)
    return "demanded";
  if (key.form == Key::Form::choice)
    return "\"" + key.choices.front() + "\"";
  if (key.form == Key::Form::truth)
    return key.fallback.value_or(0.) != 0. ? "true" : "false";
  if (key.fallback)
    return std::isfinite(*key.fallback) ? exact_text(*key.fallback) : "none";
  return key.otherwise;
}

} // namespace gestell::apps

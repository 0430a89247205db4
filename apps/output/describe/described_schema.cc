#include "apps/output/describe/described_schema.h"

#include <algorithm>

namespace gestell::apps
{

namespace
{

/// "objects", "arrays of numbers"
std::string plural(const std::string &name)
{
  const std::string array = "array";
  return name.rfind(array, 0) == 0 ? array + 's' + name.substr(array.size()) : name + 's';
}

/// "number or null", "array of objects"
std::string type_name(const Json &schema)
{
  const Json       &type = schema["type"];
  const std::string name = type.is_array() ? type[0] : type;
  return (name == "array" ? "array of " + plural(type_name(schema["items"])) : name) +
         (schema.contains("~optional") ? " or null" : "");
}

} // namespace

Json published(const Json &schema)
{
  return Json::parse(schema.dump(), [](int, Json::parse_event_t event, const Json &key)
                     { return event != Json::parse_event_t::key || key.get<std::string>().rfind('~', 0) != 0; });
}

namespace
{

/// "unit of the signal" for the member `unit` with the meaning "of the signal".
std::string whole_meaning(const std::string &name, const std::string &meaning)
{
  if (meaning.rfind("of ", 0) != 0)
    return meaning;
  const std::string hertz = "_hz";
  const bool        ends  = name.size() > hertz.size() && name.substr(name.size() - hertz.size()) == hertz;
  std::string       words = ends ? name.substr(0, name.size() - hertz.size()) : name;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words + ' ' + meaning;
}

/// "`t` [s], `modes` (`mode`, `energy` [J])": members without their meaning.
std::string member_names(const Json &schema)
{
  for (const char *inner : {"items", "additionalProperties"})
    if (schema.contains(inner))
      return member_names(schema[inner]);
  std::string names;
  if (schema.contains("properties"))
    for (const auto &[name, own] : schema["properties"].items())
    {
      const std::string unit = own["~"][0], inner = member_names(own);
      names += (names.empty() ? "`" : ", `") + name + '`' + (unit.empty() ? "" : " [" + unit + "]") +
               (inner.empty() ? "" : " (" + inner + ")");
    }
  return names;
}

} // namespace

std::string member_rows(const Json &schema, const std::string &at)
{
  if (schema.contains("items"))
    return member_rows(schema["items"], at + "[]");
  if (schema.contains("additionalProperties"))
    return member_rows(schema["additionalProperties"], at + ".NAME");
  std::string rows;
  if (schema.contains("properties"))
    for (const auto &[name, own] : schema["properties"].items())
    {
      const Json       &always = schema["required"];
      const std::string path = (at.empty() ? "" : at + '.') + name, unit = own["~"][0], meaning = own["~"][1],
                        inner = at.empty() ? "" : member_names(own);
      rows += "| `" + path + "` | " + type_name(own) +
              (std::find(always.begin(), always.end(), name) == always.end() ? ", if any" : "") + " | " + unit + " | " +
              whole_meaning(name, meaning) + (inner.empty() ? "" : ": " + inner) + " |\n" +
              (at.empty() ? member_rows(own, path) : "");
    }
  return rows;
}

} // namespace gestell::apps

#include "apps/output/tables/summary_json.h"

#include "apps/output/describe/described_json.h"
#include "apps/output/describe/described_schema.h"
#include "apps/output/values/result_description.h"

namespace gestell::apps
{
namespace
{

/// Adds the units of the members that there are, by paths as of member_rows().
void add_units(const Json &schema, const Json &value, const std::string &at, Json &units)
{
  const auto of_items = [&](const char *items, const char *place)
  {
    if (schema.contains(items) && (value.is_array() || value.is_object()))
      for (const Json &item : value)
        add_units(schema[items], item, at + place, units);
  };
  of_items("items", "[]");
  of_items("additionalProperties", ".NAME");
  if (!schema.contains("properties") || !value.is_object())
    return;
  for (const auto &[name, own] : schema["properties"].items())
    if (const auto member = value.find(name); member != value.end())
    {
      const std::string path = (at.empty() ? "" : at + '.') + name;
      if (const std::string unit = own["~"][0]; !unit.empty())
        units[path] = unit;
      add_units(own, *member, path, units);
    }
}

} // namespace

std::string summary_json(const Result &result)
{
  Json json = described_json(result);
  add_units(object_schema(result), json, "", json["units"]);
  return json_text(json);
}

std::string summary_members(const Result &all)
{
  return member_rows(object_schema(all));
}

std::string summary_schema(const Result &all)
{
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "summary.json of gestell"}};
  schema.update(object_schema(all));
  return json_text(published(schema));
}

} // namespace gestell::apps

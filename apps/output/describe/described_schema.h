#pragma once

#include "apps/output/describe/described.h"
#include "apps/output/text/json.h"

#include <string>

namespace gestell::apps
{

template <class T>
Json described_schema();

/// Writes the members as a JSON schema.  Keys that begin with "~" are for member_rows(): "~" has unit and meaning,
/// "~optional" marks what can be null.  Include this header in .cc files only, as Json.
struct SchemaMembers
{
  Json properties = Json::object(), required = Json::array();

  template <class T>
  void operator()(const char *name, const T &value, const std::string &unit = "", const char *meaning = "")
  {
    required.push_back(name);
    maybe(true, name, value, unit, meaning);
  }
  template <class T>
  void maybe(bool, const char *name, const T &, const std::string &unit = "", const char *meaning = "")
  {
    Json &schema = properties[name] = described_schema<T>();
    schema["description"]           = std::string(meaning) + (unit.empty() ? "" : " [" + unit + "]");
    schema["~"]                     = {unit, meaning};
  }
};

/// Schema of a described value, with `value` in place of T{}.
template <class T>
Json object_schema(const T &value)
{
  SchemaMembers members;
  describe(members, value);
  return {{"type", "object"}, {"properties", members.properties}, {"required", members.required}};
}

template <class T>
Json described_schema()
{
  if constexpr (is_optional<T>)
  {
    Json schema = described_schema<typename T::value_type>();
    if (!schema["type"].is_array())
      schema["type"] = {schema["type"], "null"};
    schema["~optional"] = true;
    return schema;
  }
  else if constexpr (is_described<T>)
    return object_schema(T{});
  else if constexpr (is_pairs<T>)
    return {{"type", "object"}, {"additionalProperties", described_schema<typename T::value_type::second_type>()}};
  else if constexpr (is_list<T>)
    return {{"type", "array"},
            {"items", described_schema<std::decay_t<decltype(*std::declval<const T &>().begin())>>()}};
  else if constexpr (std::is_same_v<T, bool>)
    return {{"type", "boolean"}};
  else if constexpr (std::is_integral_v<T>)
    return {{"type", "integer"}};
  else if constexpr (std::is_arithmetic_v<T>)
    return {{"type", {"number", "null"}}}; // null: not finite
  else
    return {{"type", "string"}};
}

/// The schema without the keys that begin with "~".
Json published(const Json &schema);

/// Markdown table rows: path ("signals.NAME.max", "events[].t"), type, unit and meaning; one for each member of the
/// first two levels, which lists the names and units of deeper members.
std::string member_rows(const Json &schema, const std::string &at = "");

} // namespace gestell::apps

#pragma once

#include "apps/output/describe/described.h"
#include "apps/output/text/json.h"

namespace gestell::apps
{

template <class T>
Json described_json(const T &value);

/// Writes the members into an object.
struct JsonMembers
{
  Json json = Json::object();

  template <class T>
  void operator()(const char *name, const T &value, const std::string & = "", const char * = "")
  {
    json[name] = described_json(value);
  }
  template <class T>
  void maybe(bool is, const char *name, const T &value, const std::string & = "", const char * = "")
  {
    if (is)
      json[name] = described_json(value);
  }
};

/// Include this header in .cc files only, as Json.
template <class T>
Json described_json(const T &value)
{
  if constexpr (is_optional<T>)
    return value ? described_json(*value) : Json();
  else if constexpr (is_described<T>)
  {
    JsonMembers members;
    describe(members, value);
    return std::move(members.json);
  }
  else if constexpr (is_pairs<T>)
  {
    Json object = Json::object();
    for (const auto &[name, own] : value)
      object[name] = described_json(own);
    return object;
  }
  else if constexpr (is_list<T>)
  {
    Json array = Json::array();
    for (const auto &item : value)
      array.push_back(described_json(item));
    return array;
  }
  else
    return value;
}

} // namespace gestell::apps

#include "apps/reference/json_schema.h"

#include "apps/output/text/json.h"
#include "apps/reference/declared_tables.h"

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>

namespace gestell::apps
{
namespace
{

using Types = std::vector<std::string>;

/// The tables of a scene as they lie in each other: [frame.surface.NAME] below "frame" and "surface".
struct Place
{
  std::vector<const DeclaredTable *> tables;
  std::map<std::string, Place>       below;
  std::shared_ptr<Place>             named; ///< below any NAME
};

Place places()
{
  Place root;
  for (const DeclaredTable &table : declared_tables())
  {
    if (!table.heading.empty() && table.heading.front() != '[')
      continue; // keys of a key
    Place            *place = &root;
    std::stringstream path(table.heading.empty() ? "" : table.heading.substr(1, table.heading.size() - 2));
    for (std::string part; std::getline(path, part, '.');)
      if (part != "NAME")
        place = &place->below[part];
      else
      {
        if (!place->named)
          place->named = std::make_shared<Place>();
        place = place->named.get();
      }
    place->tables.push_back(&table);
  }
  return root;
}

Types types_of(Key::Form form)
{
  switch (form)
  {
  case Key::Form::number:
  case Key::Form::formula:
  case Key::Form::quantity:
    return {"number", "string"};
  case Key::Form::whole:
    return {"integer", "string"};
  case Key::Form::profile:
    return {"number", "string", "array"};
  case Key::Form::course:
    return {"number", "string", "array", "object"};
  case Key::Form::truth:
    return {"boolean"};
  case Key::Form::choice:
  case Key::Form::name:
  case Key::Form::text:
  case Key::Form::file:
    return {"string"};
  case Key::Form::texts:
    return {"string", "array"};
  case Key::Form::direction:
  case Key::Form::vector:
  case Key::Form::rows:
  case Key::Form::tables:
  case Key::Form::numbers:
  case Key::Form::matrix:
    return {"array"};
  case Key::Form::coefficient:
    return {"number", "string", "object"};
  case Key::Form::table:
  case Key::Form::map:
    return {"object"};
  }
  return {};
}

bool may_be(const Key &key, const std::vector<Key::Form> &forms)
{
  const auto wanted = [&](Key::Form form) { return std::find(forms.begin(), forms.end(), form) != forms.end(); };
  return wanted(key.form) || std::any_of(key.others.begin(), key.others.end(), wanted);
}

Types types_of(const Key &key)
{
  Types types = types_of(key.form);
  for (const Key::Form form : key.others)
    for (const std::string &type : types_of(form))
      if (std::find(types.begin(), types.end(), type) == types.end())
        types.push_back(type);
  return types;
}

/// Limits apply to plain numbers only; text may be an expression.
void add_range(Json &json, Key::Range range)
{
  if (range == Key::Range::from_zero)
    json["minimum"] = 0;
  if (range == Key::Range::above_zero || range == Key::Range::share)
    json["exclusiveMinimum"] = 0;
  if (range == Key::Range::share)
    json["maximum"] = 1;
}

void add_keys(Json &json, const std::vector<Key> &keys, bool open);
void add_place(Json &json, const Place &place);

/// Adds the contents of an array or a table.
void add_inside(Json &json, const Key &key)
{
  using Form = Key::Form;
  if (key.others.empty() && may_be(key, {Form::direction, Form::vector}))
    json.update({{"minItems", 3}, {"maxItems", 3}});
  if (!key.keys.empty() && may_be(key, {Form::tables, Form::profile, Form::course}))
  {
    json["items"] = {{"type", "object"}};
    add_keys(json["items"], key.keys, false);
  }
  if (!key.keys.empty() && may_be(key, {Form::table, Form::map, Form::coefficient, Form::course}))
    add_keys(json, key.keys, key.form == Form::map);
}

/// @param below  tables that are declared by themselves; may be null
Json key_schema(const Key &key, const Place *below = nullptr)
{
  Json json = {{"description", key.meaning + ": " + taken_by(key) + (key.demanded ? "; required" : "")},
               {"type", types_of(key)}};
  add_range(json, key.range);
  if (key.form == Key::Form::choice && key.others.empty())
    json["enum"] = key.choices;
  if (!below)
    add_inside(json, key);
  else if (!may_be(key, {Key::Form::map})) // whose values may be something else as well
    add_place(json, *below);
  return json;
}

void add_keys(Json &json, const std::vector<Key> &keys, bool open)
{
  json["properties"] = Json::object();
  for (const Key &key : keys)
    json["properties"][key.name] = key_schema(key);
  if (!open)
    json["additionalProperties"] = false;
}

/// Keys of all tables without a type at this place; keys of the same name accept what any of them accepts.
std::vector<Key> keys_here(const Place &place)
{
  std::vector<Key> keys;
  for (const DeclaredTable *table : place.tables)
    for (const Key &key : table->type.empty() ? table->keys : std::vector<Key>())
    {
      const auto same =
          std::find_if(keys.begin(), keys.end(), [&](const Key &known) { return known.name == key.name; });
      if (same == keys.end())
      {
        keys.push_back(key);
        continue;
      }
      same->others.push_back(key.form);
      same->others.insert(same->others.end(), key.others.begin(), key.others.end());
      for (const Key &inner : key.keys)
        if (!find_key(same->keys, inner.name))
          same->keys.push_back(inner);
    }
  return keys;
}

/// A table that is one of its types, by the key `type`.
void add_types(Json &json, const Place &place)
{
  Types names;
  Json  cases = Json::array();
  for (const DeclaredTable *table : place.tables)
    if (!table->type.empty())
    {
      names.push_back(table->type);
      cases.push_back({{"if", {{"properties", {{"type", {{"const", table->type}}}}}, {"required", Types{"type"}}}},
                       {"then", {{"$ref", "#/$defs/" + table->path}}}});
    }
  json["properties"]["type"] = key_schema(key::choice("type", names, false, "what it is"));
  json["allOf"]              = cases;
}

bool has_types(const Place &place)
{
  return std::any_of(place.tables.begin(), place.tables.end(), [](const auto *table) { return !table->type.empty(); });
}

/// Adds the members of a schema for this place.
void add_place(Json &json, const Place &place)
{
  if (place.named)
  {
    json["additionalProperties"] = {{"type", "object"}};
    add_place(json["additionalProperties"], *place.named);
    return;
  }
  if (has_types(place))
  {
    add_types(json, place);
    return;
  }
  json["properties"] = Json::object();
  for (const Key &key : keys_here(place))
  {
    const auto below             = place.below.find(key.name);
    json["properties"][key.name] = key_schema(key, below == place.below.end() ? nullptr : &below->second);
  }
  json["additionalProperties"] = false;
}

/// Keys that all types of a family share.
std::vector<Key> common_keys(const DeclaredTable &type)
{
  for (const DeclaredTable &table : declared_tables())
    if (table.heading == type.heading && table.type.empty())
      return table.keys;
  return {};
}

} // namespace

std::string json_schema()
{
  Json json = {
      {"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Scene of Gestell"}, {"type", "object"}};
  add_place(json, places());
  json["$defs"] = Json::object();
  for (const DeclaredTable &table : declared_tables())
    if (!table.type.empty())
    {
      json["$defs"][table.path] = {{"description", table.does}, {"type", "object"}};
      add_keys(json["$defs"][table.path], joined({common_keys(table), table.keys}), false);
    }
  return json_text(json);
}

} // namespace gestell::apps

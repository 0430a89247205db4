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

void write_texts(JsonWriter &json, const std::string &name, const Types &texts)
{
  json.begin_array(name);
  for (const std::string &text : texts)
    json.text("", text);
  json.end_array();
}

/// Limits hold for plain numbers alone; text may be an expression.
void write_range(JsonWriter &json, Key::Range range)
{
  if (range == Key::Range::from_zero)
    json.number("minimum", 0.);
  if (range == Key::Range::above_zero || range == Key::Range::share)
    json.number("exclusiveMinimum", 0.);
  if (range == Key::Range::share)
    json.number("maximum", 1.);
}

void write_keys(JsonWriter &json, const std::vector<Key> &keys, bool open);
void write_place(JsonWriter &json, const Place &place);

/// What an array or a table holds.
void write_inside(JsonWriter &json, const Key &key)
{
  using Form = Key::Form;
  if (key.others.empty() && may_be(key, {Form::direction, Form::vector}))
  {
    json.integer("minItems", 3);
    json.integer("maxItems", 3);
  }
  if (!key.keys.empty() && may_be(key, {Form::tables, Form::profile, Form::course}))
  {
    json.begin_object("items");
    json.text("type", "object");
    write_keys(json, key.keys, false);
    json.end_object();
  }
  if (!key.keys.empty() && may_be(key, {Form::table, Form::map, Form::coefficient, Form::course}))
    write_keys(json, key.keys, key.form == Form::map);
}

/// @param below  tables that are declared by themselves; may be null
void write_key(JsonWriter &json, const Key &key, const Place *below = nullptr)
{
  json.begin_object(key.name);
  json.text("description", key.meaning + ": " + taken_by(key) + (key.demanded ? "; demanded" : ""));
  write_texts(json, "type", types_of(key));
  write_range(json, key.range);
  if (key.form == Key::Form::choice && key.others.empty())
    write_texts(json, "enum", key.choices);
  if (!below)
    write_inside(json, key);
  else if (!may_be(key, {Key::Form::map})) // whose values may be something else as well
    write_place(json, *below);
  json.end_object();
}

void write_keys(JsonWriter &json, const std::vector<Key> &keys, bool open)
{
  json.begin_object("properties");
  for (const Key &key : keys)
    write_key(json, key);
  json.end_object();
  if (!open)
    json.boolean("additionalProperties", false);
}

/// Keys of all tables without a type that stand here; one of the same name takes what any of them takes.
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
    }
  return keys;
}

/// {"if": {"properties": {"type": {"const": "rope"}}}, "then": {"$ref": ...}}
void write_case(JsonWriter &json, const DeclaredTable &table)
{
  json.begin_object();
  json.begin_object("if");
  json.begin_object("properties");
  json.begin_object("type");
  json.text("const", table.type);
  json.end_object();
  json.end_object();
  write_texts(json, "required", {"type"});
  json.end_object();
  json.begin_object("then");
  json.text("$ref", "#/$defs/" + table.path);
  json.end_object();
  json.end_object();
}

/// A table that is one of its types, by the key `type`.
void write_types(JsonWriter &json, const Place &place)
{
  Types names;
  for (const DeclaredTable *table : place.tables)
    if (!table->type.empty())
      names.push_back(table->type);
  json.begin_object("properties");
  write_key(json, key::choice("type", names, false, "what it is"));
  json.end_object();
  json.begin_array("allOf");
  for (const DeclaredTable *table : place.tables)
    if (!table->type.empty())
      write_case(json, *table);
  json.end_array();
}

bool has_types(const Place &place)
{
  return std::any_of(place.tables.begin(), place.tables.end(), [](const auto *table) { return !table->type.empty(); });
}

/// The members of a schema for what stands here.
void write_place(JsonWriter &json, const Place &place)
{
  if (place.named)
  {
    json.begin_object("additionalProperties");
    json.text("type", "object");
    write_place(json, *place.named);
    json.end_object();
    return;
  }
  if (has_types(place))
  {
    write_types(json, place);
    return;
  }
  json.begin_object("properties");
  for (const Key &key : keys_here(place))
  {
    const auto below = place.below.find(key.name);
    write_key(json, key, below == place.below.end() ? nullptr : &below->second);
  }
  json.end_object();
  json.boolean("additionalProperties", false);
}

/// Keys that every type of a family has, beside its own.
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
  JsonWriter json;
  json.begin_object();
  json.text("$schema", "https://json-schema.org/draft/2020-12/schema");
  json.text("title", "Scene of Gestell");
  json.text("type", "object");
  write_place(json, places());
  json.begin_object("$defs");
  for (const DeclaredTable &table : declared_tables())
    if (!table.type.empty())
    {
      json.begin_object(table.path);
      json.text("description", table.does);
      json.text("type", "object");
      write_keys(json, joined({common_keys(table), table.keys}), false);
      json.end_object();
    }
  json.end_object();
  json.end_object();
  return json.document();
}

} // namespace gestell::apps

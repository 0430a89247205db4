#include "apps/reference/json_schema.h"

#include "apps/output/text/json.h"
#include "apps/reference/declared_tables.h"

namespace gestell::apps
{
namespace
{

void write_types(JsonWriter &json, const std::vector<std::string> &types)
{
  json.begin_array("type");
  for (const std::string &type : types)
    json.text("", type);
  json.end_array();
}

std::vector<std::string> types_of(Key::Form form)
{
  switch (form)
  {
  case Key::Form::number:
  case Key::Form::formula:
    return {"number", "string"};
  case Key::Form::profile:
    return {"number", "string", "array"};
  case Key::Form::course:
    return {"number", "string", "array", "object"};
  case Key::Form::truth:
    return {"boolean"};
  case Key::Form::choice:
  case Key::Form::name:
    return {"string"};
  case Key::Form::direction:
  case Key::Form::vector:
  case Key::Form::rows:
  case Key::Form::tables:
    return {"array"};
  case Key::Form::coefficient:
    return {"number", "string", "object"};
  }
  return {};
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

void write_keys(JsonWriter &json, const std::vector<Key> &keys);

void write_key(JsonWriter &json, const Key &key)
{
  json.begin_object(key.name);
  json.text("description", key.meaning + ": " + taken_by(key) + (key.demanded ? "; demanded" : ""));
  write_types(json, types_of(key.form));
  write_range(json, key.range);
  if (key.form == Key::Form::choice)
  {
    json.begin_array("enum");
    for (const std::string &choice : key.choices)
      json.text("", choice);
    json.end_array();
  }
  if (key.form == Key::Form::direction || key.form == Key::Form::vector)
  {
    json.integer("minItems", 3);
    json.integer("maxItems", 3);
  }
  if (key.form == Key::Form::tables)
  {
    json.begin_object("items");
    json.text("type", "object");
    write_keys(json, key.keys);
    json.end_object();
  }
  json.end_object();
}

void write_keys(JsonWriter &json, const std::vector<Key> &keys)
{
  json.begin_object("properties");
  for (const Key &key : keys)
    write_key(json, key);
  json.end_object();
  json.boolean("additionalProperties", false);
}

/// [element.NAME] is one of its types, by the key `type`.
void write_choice_of_type(JsonWriter &json, const std::vector<DeclaredTable> &types)
{
  json.begin_object("element");
  json.begin_object("additionalProperties");
  json.text("type", "object");
  json.begin_object("properties");
  write_key(json, *find_key(types.front().keys, "type"));
  json.end_object();
  json.begin_array("allOf");
  for (std::size_t i = 1; i < types.size(); ++i)
  {
    json.begin_object();
    json.begin_object("if");
    json.begin_object("properties");
    json.begin_object("type");
    json.text("const", types[i].path.substr(types[i].path.find('.') + 1));
    json.end_object();
    json.end_object();
    json.begin_array("required");
    json.text("", "type");
    json.end_array();
    json.end_object();
    json.begin_object("then");
    json.text("$ref", "#/$defs/" + types[i].path);
    json.end_object();
    json.end_object();
  }
  json.end_array();
  json.end_object();
  json.end_object();
}

} // namespace

std::string json_schema()
{
  const auto &tables = declared_tables();
  JsonWriter  json;
  json.begin_object();
  json.text("$schema", "https://json-schema.org/draft/2020-12/schema");
  json.text("title", "Scene of Gestell");
  json.text("type", "object");
  json.begin_object("properties");
  write_choice_of_type(json, tables);
  json.end_object();
  json.begin_object("$defs");
  for (std::size_t i = 1; i < tables.size(); ++i)
  {
    json.begin_object(tables[i].path);
    json.text("description", tables[i].does);
    json.text("type", "object");
    write_keys(json, joined({tables.front().keys, tables[i].keys}));
    json.end_object();
  }
  json.end_object();
  json.end_object();
  return json.document();
}

} // namespace gestell::apps

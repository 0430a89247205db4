#include "apps/scene/file/scene_table.h"

#include "apps/scene/file/override_rules.h"
#include "apps/scene/file/unknown_keys.h"
#include "apps/scene/file/written_text.h"
#include "fem/values/named_file.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace gestell::apps
{

using Type = SceneNode::Type;

SceneTable::SceneTable(const SceneNode &node, const Parameters &parameters, const std::string &path)
    : SceneTable(node, parameters, path, path, std::make_shared<std::vector<std::string>>())
{
}

SceneTable::SceneTable(const SceneNode &node, const Parameters &parameters, const std::string &path,
                       const std::string &name, const Warnings &warnings)
    : node_(&node), parameters_(&parameters), path_(path), name_(name), warnings_(warnings)
{
  node.used = true;
  if (node.type != Type::table)
    throw error("needs a table of keys, got " + described(node) +
                (node.type == Type::array ? "; write [" + path + "], with single brackets" : ""));
}

SceneTable SceneTable::below(const SceneNode &node, const std::string &path, const std::string &name) const
{
  return {node, *parameters_, path, name, warnings_};
}

// --- places and errors

std::string SceneTable::path_of(const std::string &key) const
{
  return (path_.empty() ? "" : path_ + ".") + written_key(key);
}

std::string SceneTable::name() const
{
  return name_;
}

std::string SceneTable::place() const
{
  return node_->place.text() + (path_.empty() ? "" : ": " + path_ + changes_words(*node_));
}

std::string SceneTable::place(const std::string &key) const
{
  const SceneNode *value = node_->find(key);
  return (value ? value->place : node_->place).text() + ": " + path_of(key);
}

std::invalid_argument SceneTable::error(const std::string &what) const
{
  if (const auto unknown = keys_ && !open_ ? unknown_key(*node_, *keys_, path_) : std::nullopt)
    return *unknown;
  return std::invalid_argument(place() + ": " + what);
}

std::invalid_argument SceneTable::error(const std::string &key, const std::string &what) const
{
  return std::invalid_argument(place(key) + ": " + what);
}

void SceneTable::warn(const std::string &key, const std::string &what) const
{
  // A warning of several readers is added once.
  const std::string warning = place(key) + ": " + what;
  if (std::find(warnings_->begin(), warnings_->end(), warning) == warnings_->end())
    warnings_->push_back(warning);
}

const SceneNode *SceneTable::look_up(const std::string &key) const
{
  if (keys_ && !open_)
    declaration(key);
  node_->requested.insert(key);
  const SceneNode *value = node_->find(key);
  if (value)
    value->used = true;
  return value;
}

const SceneNode &SceneTable::demand(const std::string &key, const std::string &what) const
{
  const SceneNode *value = look_up(key);
  if (value)
    return *value;
  std::vector<std::string> unknown;
  for (const auto &entry : node_->entries)
    if (!node_->requested.count(entry.first))
      unknown.push_back(entry.first);
  const auto meant = nearest_name(key, unknown);
  throw error("the key '" + key + "' is missing; it needs " + what +
              (meant.empty() ? "" : "; is '" + meant + "' a misspelling of it?"));
}

bool SceneTable::has(const std::string &key) const
{
  return look_up(key) != nullptr;
}

bool SceneTable::is_text(const std::string &key) const
{
  const auto *value = look_up(key);
  return value && value->type == Type::text;
}

bool SceneTable::is_array(const std::string &key) const
{
  const auto *value = look_up(key);
  return value && value->type == Type::array;
}

bool SceneTable::is_matrix(const std::string &key) const
{
  return is_array(key) && !look_up(key)->elements.empty() && look_up(key)->elements.front().type == Type::array;
}

bool SceneTable::is_table(const std::string &key) const
{
  const auto *value = look_up(key);
  return value && value->type == Type::table;
}

std::vector<std::string> SceneTable::keys() const
{
  std::vector<std::string> result;
  for (const auto &entry : node_->entries)
    result.push_back(entry.first);
  return result;
}

// --- numbers

double SceneTable::evaluate(const std::string &key, const SceneNode &value, const Kind &kind) const
{
  return expression(key, value, {}, kind).constant();
}

mechanism::Formula SceneTable::expression(const std::string &key, const SceneNode &value,
                                          const std::vector<Variable> &variables, const Kind &kind) const
{
  const std::string at = value.place.text() + ": " + path_of(key) + ": ";
  if (value.type != Type::text && value.type != Type::integer && value.type != Type::real)
    throw std::invalid_argument(at + "needs " + with_article(kind) + " such as \"" + kind.example + "\", got " +
                                described(value));
  try
  {
    const mechanism::Formula result = formula_as(parameters_->expression(value, variables, &kind), kind, value.text);
    if (result.is_constant() && !std::isfinite(result.constant()))
      throw std::invalid_argument("needs a finite number, got " + value.text);
    return result;
  }
  catch (const std::invalid_argument &e)
  {
    const bool formula = variables.empty() && is_formula_of_time(value, kind);
    throw std::invalid_argument(
        at + e.what() +
        (formula ? ". It would be a formula of the time t, but this key takes a value: t is a tonne" : ""));
  }
}

bool SceneTable::is_formula_of_time(const SceneNode &value, const Kind &kind) const
{
  if (value.type != Type::text)
    return false;
  try
  {
    return !formula_as(parameters_->expression(value, {{"t", "time", kind::time.dimension}}), kind, value.text)
                .is_constant();
  }
  catch (const std::invalid_argument &)
  {
    return false;
  }
}

mechanism::Formula SceneTable::formula(const std::string &key, const std::vector<Variable> &variables,
                                       const Kind &kind) const
{
  return expression(key, demand(key, "a formula of " + with_article(kind)), variables, kind);
}

double SceneTable::number(const std::string &key, const Kind &kind) const
{
  return evaluate(key, demand(key, with_article(kind) + " such as \"" + kind.example + "\""), kind);
}

Quantity SceneTable::quantity(const std::string &key) const
{
  const SceneNode &value = demand(key, "a value such as \"287.9 kN\"");
  if (value.type != Type::text && value.type != Type::integer && value.type != Type::real)
    throw error(key, "needs a value such as \"287.9 kN\", got " + described(value));
  try
  {
    return parameters_->evaluate(value);
  }
  catch (const std::invalid_argument &e)
  {
    throw error(key, e.what());
  }
}

double SceneTable::number(const std::string &key, const Kind &kind, double fallback) const
{
  return has(key) ? number(key, kind) : fallback;
}

double SceneTable::positive(const std::string &key, const Kind &kind) const
{
  const double value = number(key, kind);
  if (value <= 0.)
    throw error(key, "needs " + with_article(kind) + " above zero such as \"" + kind.example + "\", got " +
                         with_value(node_->find(key)->text, value));
  return value;
}

double SceneTable::positive(const std::string &key, const Kind &kind, double fallback) const
{
  return has(key) ? positive(key, kind) : fallback;
}

double SceneTable::not_negative(const std::string &key, const Kind &kind) const
{
  const double value = number(key, kind);
  if (value < 0.)
    throw error(key,
                "needs " + with_article(kind) + " of zero or more, got " + with_value(node_->find(key)->text, value));
  return value;
}

double SceneTable::not_negative(const std::string &key, const Kind &kind, double fallback) const
{
  return has(key) ? not_negative(key, kind) : fallback;
}

int SceneTable::integer(const std::string &key, int fallback) const
{
  const SceneNode *value = look_up(key);
  if (!value)
    return fallback;
  const double number = evaluate(key, *value, kind::number);
  if (value->type == Type::real || number != std::round(number) || std::abs(number) > 1e9)
    throw error(key, "needs an integer, got " + value->text);
  return static_cast<int>(number);
}

bool SceneTable::boolean(const std::string &key, bool fallback) const
{
  const SceneNode *value = look_up(key);
  if (!value)
    return fallback;
  if (value->type != Type::boolean)
    throw error(key, "needs true or false without quotes, got " + type_name(value->type) + " " + value->text);
  return value->boolean;
}

// --- arrays of numbers

std::vector<double> SceneTable::numbers(const std::string &key, const Kind &kind) const
{
  const SceneNode &value = demand(key, "an array of values");
  if (value.type != Type::array)
    throw error(key, "needs an array such as [\"" + kind.example + "\", 0], got " + described(value));
  std::vector<double> result;
  for (const auto &element : value.elements)
    result.push_back(evaluate(key, element, kind));
  return result;
}

std::vector<std::vector<double>> SceneTable::matrix(const std::string &key, const Kind &kind) const
{
  const SceneNode &value = demand(key, "a matrix, an array of rows");
  if (value.type != Type::array || value.elements.empty())
    throw error(key, "needs a matrix, an array of rows [[..], [..]]");
  std::vector<std::vector<double>> rows;
  for (const auto &row : value.elements)
  {
    if (row.type != Type::array)
      throw error(key, "needs a matrix, an array of rows [[..], [..]]; row " + std::to_string(rows.size() + 1) +
                           " is " + type_name(row.type));
    rows.emplace_back();
    for (const auto &element : row.elements)
      rows.back().push_back(evaluate(key, element, kind));
    if (rows.back().size() != rows.front().size())
      throw error(key, "row " + std::to_string(rows.size()) + " has " + std::to_string(rows.back().size()) +
                           " entries, the first one " + std::to_string(rows.front().size()));
  }
  return rows;
}

std::vector<std::array<double, 2>> SceneTable::pairs(const std::string &key, const Kind &first,
                                                     const Kind &second) const
{
  const std::string wanted = "rows of two values [[\"" + first.example + "\", \"" + second.example + "\"], [..]]";
  const SceneNode  &value  = demand(key, wanted);
  if (value.type != Type::array || value.elements.empty())
    throw error(key, "needs " + wanted + ", got " + (value.type == Type::array ? "an empty array" : described(value)));
  std::vector<std::array<double, 2>> rows;
  for (const auto &row : value.elements)
  {
    if (row.type != Type::array || row.elements.size() != 2)
      throw error(key, "needs " + wanted + "; row " + std::to_string(rows.size() + 1) + " is " +
                           (row.type == Type::array ? "of " + std::to_string(row.elements.size()) + " values"
                                                    : described(row)));
    rows.push_back({evaluate(key, row.elements[0], first), evaluate(key, row.elements[1], second)});
  }
  return rows;
}

Vector3 SceneTable::vector(const std::string &key, const Kind &kind) const
{
  if (const SceneNode &value = demand(key, "three numbers [x, y, z]"); value.type != Type::array)
    throw error(key, "needs three numbers [x, y, z], got " + described(value));
  const auto x = numbers(key, kind);
  if (x.size() != 3)
    throw error(key, "needs three values [x, y, z], got " + std::to_string(x.size()));
  return {x[0], x[1], x[2]};
}

Vector3 SceneTable::direction(const std::string &key) const
{
  Vector3      d      = vector(key, kind::number);
  const double length = std::hypot(d[0], d[1], d[2]);
  if (length == 0.)
    throw error(key, "is a direction and cannot be [0, 0, 0]");
  for (double &x : d)
    x /= length;
  return d;
}

Vector3 SceneTable::direction(const std::string &key, const Vector3 &fallback) const
{
  return has(key) ? direction(key) : fallback;
}

// --- texts

std::string SceneTable::text(const std::string &key) const
{
  const SceneNode &value = demand(key, "a string in quotes");
  if (value.type != Type::text)
    throw error(key, "needs a string in quotes, got " + described(value));
  if (value.text.empty())
    throw error(key, "needs a string, got an empty one");
  return value.text;
}

std::string SceneTable::text(const std::string &key, const std::string &fallback) const
{
  return has(key) ? text(key) : fallback;
}

std::string SceneTable::choice(const std::string &key, const std::vector<std::string> &valid,
                               const std::string &fallback) const
{
  if (fallback.empty() && !has(key))
    demand(key, "one of " + listed(valid));
  const std::string chosen = text(key, fallback);
  if (std::find(valid.begin(), valid.end(), chosen) != valid.end())
    return chosen;
  const auto nearest = nearest_name(chosen, valid);
  throw error(key, "there is no '" + chosen + "'; valid: " + listed(valid) +
                       (nearest.empty() ? "" : "; did you mean '" + nearest + "'?"));
}

std::vector<std::string> SceneTable::texts(const std::string &key) const
{
  const SceneNode &value = demand(key, "a string in quotes or a list of strings");
  if (value.type != Type::array)
    return {text(key)};
  std::vector<std::string> result;
  for (const auto &element : value.elements)
  {
    if (element.type != Type::text || element.text.empty())
      throw error(key, "needs a list of strings in quotes, got " + described(element) + " in it");
    result.push_back(element.text);
  }
  if (result.empty())
    throw error(key, "needs at least one string, got an empty array");
  return result;
}

std::string SceneTable::file(const std::string &key) const
{
  const std::string given = text(key), folder = node_->find(key)->folder;
  const auto        path = (std::filesystem::path(folder) / given).lexically_normal();
  if (const std::string reason = fem::why_unreachable(path); !reason.empty())
    throw error(key, "the file \"" + given + "\" " + reason);
  if (!std::filesystem::exists(path))
    throw error(key, "there is no file \"" + given + "\" (" + path.string() + "); relative paths start at " + folder);
  if (const std::string other = fem::other_than_file(path); !other.empty())
    throw error(key, "\"" + given + "\" is " + other + "; a file is needed");
  return path.string();
}

// --- tables

SceneTable SceneTable::table(const std::string &key) const
{
  return inner(below(demand(key, "a table of keys"), path_of(key), key), key);
}

std::optional<SceneTable> SceneTable::optional_table(const std::string &key) const
{
  return has(key) ? std::optional<SceneTable>(table(key)) : std::nullopt;
}

std::vector<SceneTable> SceneTable::tables(const std::string &key) const
{
  std::vector<SceneTable> result;
  if (const auto all = optional_table(key))
    for (const auto &name : all->keys())
      result.push_back(all->table(name));
  return result;
}

std::vector<SceneTable> SceneTable::table_array(const std::string &key) const
{
  std::vector<SceneTable> result;
  const SceneNode        *value = look_up(key);
  if (!value)
    return result;
  if (value->type != Type::array)
    throw error(key, "needs an array of tables [{ ... }, { ... }], got " + described(*value) +
                         (value->type == Type::table ? "; write [[" + path_of(key) + "]], with double brackets" : ""));
  for (const auto &element : value->elements)
    result.push_back(inner(below(element, path_of(key) + "[" + std::to_string(result.size() + 1) + "]", key), key));
  return result;
}

void SceneTable::finish() const
{
  refuse_unknown(*node_, path_);
}

} // namespace gestell::apps

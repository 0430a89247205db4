#include "apps/scene/file/parameters.h"

#include "apps/scene/file/override_rules.h"
#include "apps/scene/language/parse_quantity.h"
#include "apps/scene/language/tokens.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

[[noreturn]] void fail(const SceneNode &value, const std::string &name, const std::string &what)
{
  throw std::invalid_argument(value.place.text() + ": parameters." + written_key(name) + ": " + what);
}

void check_name(const SceneNode &value, const std::string &name)
{
  if (!is_identifier(name))
    fail(value, name,
         "the name of a parameter consists of letters, digits and underscores and does not begin with a digit");
  if (is_reserved_name(name))
    fail(value, name, "'" + name + "' is a function or constant of expressions; choose another name");
}

} // namespace

struct Parameters::Table
{
  explicit Table(const SceneNode &table)
  {
    for (const auto &[name, value] : table.entries)
    {
      entries.emplace(name, &value);
      names.push_back(name);
    }
  }

  std::map<std::string, const SceneNode *> entries;
  std::vector<std::string>                 names;
};

Parameters::Parameters(const SceneNode *table)
{
  if (!table)
    return;
  table->used = true;
  if (table->type != SceneNode::Type::table)
    throw std::invalid_argument(table->place.text() + ": parameters: needs a table, got " + type_name(table->type));
  for (const auto &[name, value] : table->entries)
    check_name(value, name);
  const Table by_name(*table);
  for (const std::string &name : by_name.names)
  {
    std::vector<std::string> open;
    evaluate_entry(by_name, name, open);
  }
  for (const auto &entry : values_)
    names_.push_back(entry.first);
}

Quantity Parameters::evaluate_entry(const Table &table, const std::string &name, std::vector<std::string> &open)
{
  if (const auto known = values_.find(name); known != values_.end())
    return known->second;
  const SceneNode &value = *table.entries.at(name);
  value.used             = true;
  if (from_command_line(value))
    overrides_.emplace(name, value.place);
  if (const auto first = std::find(open.begin(), open.end(), name); first != open.end())
  {
    std::string circle;
    for (auto i = first; i != open.end(); ++i)
      circle += *i + " -> ";
    fail(value, name, "depends on itself: " + circle + name);
  }
  constexpr std::size_t longest_chain = 500; // of parameters that need each other; each takes some of the stack
  if (open.size() >= longest_chain)
    fail(value, name,
         "is at the end of a chain of " + std::to_string(longest_chain) +
             " parameters; define parameters before those that use them");
  open.push_back(name);

  Quantity result;
  if (value.type == SceneNode::Type::integer || value.type == SceneNode::Type::real)
    result = Quantity{value.number, {}, false, Counts::nothing};
  else if (value.type != SceneNode::Type::text)
    fail(value, name, "needs a number or a string such as \"40 mm\", got " + type_name(value.type));
  else
    try
    {
      result = parse_quantity(
          value.text,
          [&](const std::string &other) -> std::optional<Quantity>
          {
            if (table.entries.count(other) == 0)
              return std::nullopt;
            needs_[name].insert(other);
            return evaluate_entry(table, other, open);
          },
          table.names);
    }
    catch (const std::invalid_argument &e)
    {
      const std::string message = e.what();
      if (message.find(": parameters.") != std::string::npos)
        throw; // the message already names the place
      fail(value, name, message);
    }
  if (!std::isfinite(result.value))
    fail(value, name, "is not a finite number");
  open.pop_back();
  return values_[name] = result;
}

std::optional<Quantity> Parameters::find(const std::string &name) const
{
  const auto found = values_.find(name);
  return found == values_.end() ? std::nullopt : std::optional<Quantity>(found->second);
}

const std::vector<std::string> &Parameters::names() const
{
  return names_;
}

Quantity Parameters::evaluate(const SceneNode &value) const
{
  const Expression e = expression(value, {});
  return {e.formula.constant(), e.dimension, e.checked, e.counts};
}

Expression Parameters::expression(const SceneNode &value, const std::vector<Variable> &variables,
                                  const Kind *kind) const
{
  if (value.type == SceneNode::Type::text)
    return parse_expression(
        value.text, variables,
        [this](const std::string &name)
        {
          use(name);
          return find(name);
        },
        names_, kind);
  return Quantity{value.number, {}, false, Counts::nothing};
}

void Parameters::use(const std::string &name) const
{
  std::vector<std::string> waiting = {name}; // no recursion, as chains may be long
  while (!waiting.empty())
  {
    const std::string next = std::move(waiting.back());
    waiting.pop_back();
    if (values_.count(next) == 0 || !used_.insert(next).second)
      continue;
    if (const auto needed = needs_.find(next); needed != needs_.end())
      waiting.insert(waiting.end(), needed->second.begin(), needed->second.end());
  }
}

void Parameters::refuse_idle_overrides() const
{
  for (const auto &[name, place] : overrides_)
    if (used_.count(name) == 0)
      throw IdleParameter(place.text() + ": no value of the scene depends on the parameter '" + name +
                          "', so it has no effect" + suggestion(name, {used_.begin(), used_.end()}));
}

} // namespace gestell::apps

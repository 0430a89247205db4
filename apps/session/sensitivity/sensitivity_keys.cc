#include "apps/session/sensitivity/sensitivity_keys.h"

#include "apps/scene/file/parameters.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/language/parse_quantity.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"
#include "fem/values/trimmed.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace gestell::apps
{

namespace
{
constexpr double share = 1e-6; ///< relative change of a value: rounding and curvature of laws are then 1e-9

[[noreturn]] void refuse(const std::string &key, const std::string &what)
{
  throw std::invalid_argument("--sensitivities " + key + ": " + what);
}

/// Splits a string at separators outside quotes; the quotes of a whole part are removed.
std::vector<std::string> split_outside_quotes(const std::string &text, char separator)
{
  std::vector<std::string> parts(1);
  char                     quote = '\0';
  for (const char c : text)
  {
    if (!quote && c == separator)
    {
      parts.emplace_back();
      continue;
    }
    if (c == quote)
      quote = '\0';
    else if (!quote && (c == '"' || c == '\''))
      quote = c;
    parts.back() += c;
  }
  return parts;
}

std::string without_quotes(const std::string &text)
{
  const bool quoted = text.size() > 1 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return quoted ? text.substr(1, text.size() - 2) : text;
}

/// Tables on which no motion depends.
void refuse_settings(const std::string &key, const std::string &table)
{
  static const std::map<std::string, std::string> settings = {{"name", "the name of the scene"},
                                                              {"description", "the description of the scene"},
                                                              {"modes", "the listed modes and their configuration"},
                                                              {"output", "the requested results"},
                                                              {"reduction", "the reduction of the frame"}};
  if (const auto found = settings.find(table); found != settings.end())
    refuse(key, "this key sets " + found->second +
                    "; a run has no derivative by it; name a parameter (parameters.NAME) or a number of a body, an "
                    "element, a load or a joint");
  if (table == "run" && key != "run.end")
    refuse(key, "this key sets the integration of the run; a run has no derivative by it; name a parameter "
                "(parameters.NAME) or a number of a body, an element, a load or a joint");
}

const SceneNode &node_of(const SceneNode &root, const std::string &key)
{
  const SceneNode *node = &root;
  std::string      path;
  for (const std::string &part : split_outside_quotes(key, '.'))
  {
    const std::string name       = without_quotes(part);
    const SceneNode  *next       = node->type == SceneNode::Type::table ? node->find(name) : nullptr;
    const SceneNode  *parameters = root.find("parameters");
    if (!next && path.empty() && parameters && parameters->find(name))
      refuse(key, "the scene has no key \"" + name + "\", but a parameter of that name; write parameters." + name);
    if (!next)
      refuse(key, node->place.text() + ": " + (path.empty() ? "the scene" : path) + " has no key \"" + name + "\"" +
                      suggestion(name, names_in(node)));
    path += (path.empty() ? "" : ".") + name;
    node = next;
  }
  return *node;
}

Quantity value_of(const std::string &key, const SceneNode &node, const Parameters &parameters)
{
  const bool number = node.type == SceneNode::Type::integer || node.type == SceneNode::Type::real;
  if (!number && node.type != SceneNode::Type::text)
    refuse(key, node.place.text() + " is " + type_name(node.type) + "; name a key with one number");
  try
  {
    return parameters.evaluate(node);
  }
  catch (const std::invalid_argument &)
  {
    refuse(key, node.place.text() + ": " + described(node) +
                    " is not a number, so it has no small change; name a key with a number, such as \"40 mm\"");
  }
}

VariedKey varied(const std::string &key, const SceneNode &root, const Parameters &parameters)
{
  refuse_settings(key, without_quotes(split_outside_quotes(key, '.').front()));
  const SceneNode &node     = node_of(root, key);
  const Quantity   quantity = value_of(key, node, parameters);
  if (quantity.value == 0.)
    refuse(key,
           node.place.text() + " is 0, which gives no step for a difference quotient; set a small value, or remove it");
  VariedKey found;
  found.reported.key   = key;
  found.reported.value = quantity.value;
  if (quantity.checked && quantity.dimension != Dimension{})
    found.reported.unit = describe(quantity.dimension);
  found.text = node.text;
  if (node.type != SceneNode::Type::text && found.text.empty())
    append_exact(found.text, node.number);
  found.step = share * std::abs(quantity.value);
  return found;
}

/// A number with its unit, no expression of other parameters.
bool stands_alone(const SceneNode &node)
{
  if (node.type != SceneNode::Type::text)
    return node.type == SceneNode::Type::integer || node.type == SceneNode::Type::real;
  try
  {
    parse_quantity(node.text, [](const std::string &) { return std::optional<Quantity>(); });
    return true;
  }
  catch (const std::invalid_argument &)
  {
    return false;
  }
}

std::vector<std::string> all_keys(const SceneNode &root, const Parameters &parameters,
                                  std::vector<std::string> *left_out)
{
  std::vector<std::string> keys;
  std::string              zero;
  const SceneNode         *table = root.find("parameters");
  for (std::size_t i = 0; table && i < table->entries.size(); ++i)
    if (const auto &[name, node] = table->entries[i]; stands_alone(node))
    {
      if (parameters.find(name)->value != 0.)
        keys.push_back("parameters." + name);
      else
        zero += (zero.empty() ? "" : ", ") + name;
    }
  if (keys.empty())
    refuse("all", "all [parameters] of the scene are zero; name keys such as element.NAME.stiffness");
  if (left_out && !zero.empty())
    left_out->push_back(
        "--sensitivities all omits parameters that are 0, which give no step for a difference quotient: " + zero);
  return keys;
}

} // namespace

/// Entries with a unit take numbers without one, but no expressions of such.
std::string VariedKey::overridden(double by) const
{
  if (text.find_first_not_of("+-.0123456789eE") == std::string::npos)
  {
    std::string number;
    append_exact(number, reported.value * (1. + (by * reported.value > 0. ? 1. : -1.) * share * std::abs(by)));
    return reported.key + '=' + number + (number.find_first_of(".e") == std::string::npos ? ".0" : "");
  }
  // An integer in the file in place of a real number is written as a string.
  std::string text_of_share;
  append_exact(text_of_share, share * std::abs(by));
  return reported.key + "=\"(" + text + ")*(1 " + (by * reported.value > 0. ? "+ " : "- ") + text_of_share + ")\"";
}

std::vector<VariedKey> varied_keys(const SceneNode &root, const std::string &list, std::vector<std::string> *left_out)
{
  if (trimmed(list).empty())
    throw std::invalid_argument(
        "--sensitivities needs scene keys, such as parameters.c_P,parameters.s_cl, or all; it is empty");
  const Parameters         parameters(root.find("parameters"));
  std::vector<std::string> keys;
  if (trimmed(list) == "all")
    keys = all_keys(root, parameters, left_out);
  else
    for (const std::string &part : split_outside_quotes(list, ','))
      keys.push_back(trimmed(part));
  std::vector<VariedKey> found;
  for (const std::string &key : keys)
  {
    if (key.empty())
      refuse("\"" + list + "\"", "needs keys with commas between them, such as parameters.c_P,parameters.s_cl, or all");
    if (std::any_of(found.begin(), found.end(), [&](const VariedKey &other) { return other.reported.key == key; }))
      refuse(key, "is named twice");
    found.push_back(varied(key, root, parameters));
  }
  return found;
}

} // namespace gestell::apps

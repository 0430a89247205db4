#include "apps/scene/file/scene_override.h"

#include "apps/scene/file/override_rules.h"
#include "apps/scene/file/toml_hint.h"
#include "apps/scene/file/toml_text.h"
#include "fem/values/trimmed.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

SceneNode override_value(const std::string &text, const Place &place)
{
  const auto folder = std::filesystem::current_path().string();
  if (auto value = parse_toml_value(text, place, folder))
    return *value;
  if (const auto hint = toml_hint("value = " + text); !hint.empty() && (text.front() == '[' || text.front() == '{'))
    place.fail(hint);
  SceneNode node; // not TOML, so it is text: --set run.method=bdf, --set run.step=10 us
  node.type   = SceneNode::Type::text;
  node.place  = place;
  node.folder = folder;
  node.text   = text;
  return node;
}

/// First '=' outside quotes.
std::size_t equals_sign(const std::string &text)
{
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i)
    if (quote)
      quote = text[i] == quote ? '\0' : quote;
    else if (text[i] == '"' || text[i] == '\'')
      quote = text[i];
    else if (text[i] == '=')
      return i;
  return std::string::npos;
}

} // namespace

std::vector<std::string> names_in(const SceneNode *table)
{
  std::vector<std::string> names;
  for (std::size_t i = 0; table && i < table->entries.size(); ++i)
    names.push_back(table->entries[i].first);
  return names;
}

std::vector<std::string> key_segments(const std::string &path, const Place &place)
{
  std::vector<std::string> result;
  std::size_t              i = 0;
  do
  {
    const char  quote = i < path.size() ? path[i] : '\0';
    std::size_t end;
    if (quote == '"' || quote == '\'')
    {
      end = path.find(quote, i + 1);
      if (end == std::string::npos)
        place.fail("the key lacks a closing quote");
      result.push_back(path.substr(i + 1, end - i - 1));
      ++end;
    }
    else
    {
      end = std::min(path.find('.', i), path.size());
      result.push_back(path.substr(i, end - i));
    }
    constexpr std::size_t deepest_key = 50; // tables in each other, as in a file: each takes some of the stack
    if (result.size() > deepest_key)
      place.fail("the key goes more than " + std::to_string(deepest_key) + " tables deep; a scene has at most six");
    if (result.back().empty() || (end < path.size() && path[end] != '.'))
      place.fail("is not a key path such as run.step or frame.surface.\"crown bearing\".faces");
    i = end + 1;
  } while (i <= path.size());
  return result;
}

std::pair<std::string, SceneNode> parsed_override(const std::string &text)
{
  const Place place{"--set " + text, 0};
  const auto  equals = equals_sign(text);
  if (equals == std::string::npos)
    place.fail("needs the form key.path=value, for example --set run.step=\"5 us\"");
  const std::string key = trimmed(text.substr(0, equals));
  if (key_segments(key, place).front() == "extends")
    place.fail("the key 'extends' of a scene cannot be overridden");
  return {key, override_value(trimmed(text.substr(equals + 1)), place)};
}

void apply_override(SceneNode &root, const std::string &text)
{
  const auto [key, value] = parsed_override(text);
  apply_override(root, key, value);
}

void apply_override(SceneNode &root, const std::string &key, const SceneNode &value)
{
  const Place &place = value.place;
  const auto   path  = key_segments(key, place);
  if (path.front() == "extends")
    place.fail("the key 'extends' of a scene cannot be overridden");
  if (SceneNode *run = root.find("run"); run && path.size() == 2 && path.front() == "run")
  {
    SceneNode newer;
    newer.entries.emplace_back(path.back(), value);
    make_way(*run, newer);
  }
  if (path.size() == 2 && path.front() == "frame")
  {
    SceneNode newer;
    newer.entries.emplace_back(path.back(), value);
    make_way_for_frame(root, newer);
  }

  SceneNode *node = &root;
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    if (node->type != SceneNode::Type::table)
      place.fail("'" + path[i - 1] + "' is " + type_name(node->type) + " (" + node->place.text() +
                 ") and has no key '" + path[i] + "'");
    if (!node->find(path[i]))
    {
      node->entries.emplace_back(path[i], SceneNode{});
      node->entries.back().second.place = place;
    }
    node = node->find(path[i]);
  }
  *node = value;
}

} // namespace gestell::apps

#include "apps/scene/file/toml_text.h"

#include "apps/scene/file/toml_hint.h"
#include "fem/values/named_file.h"
#include "fem/values/number_text.h"

#include <toml.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace gestell::apps
{
namespace
{

using Type = SceneNode::Type;

/// toml11 draws its message over several lines with a picture of the text; one line is enough with file and line.
std::string first_line(const std::string &message)
{
  std::string line = message.substr(0, message.find('\n'));
  for (const std::string prefix : {"[error] ", "toml::"})
    if (line.compare(0, prefix.size(), prefix) == 0)
      line.erase(0, prefix.size());
  if (const auto colon = line.find(": "); colon != std::string::npos && line.find(' ') > colon)
    line.erase(0, colon + 2); // the name of the parser's function
  const auto note = message.rfind("^--- ");
  if (note != std::string::npos)
    line += ": " + message.substr(note + 5, message.find('\n', note) - note - 5);
  return line;
}

std::string line_of(const std::string &text, std::size_t number)
{
  std::istringstream in(text);
  std::string        line;
  for (std::size_t i = 0; i < number && std::getline(in, line); ++i)
    ;
  return line;
}

constexpr int deepest = 50; ///< levels of nested tables and arrays; parsers recurse on the stack

/// Past a string that begins at i: to its closing quotes, or the end of the text.
std::size_t behind_string(const std::string &text, std::size_t i)
{
  const char  quote  = text[i];
  const bool  triple = text.compare(i, 3, std::string(3, quote)) == 0;
  std::size_t at     = i + (triple ? 3 : 1);
  for (; at < text.size(); ++at)
    if (quote == '"' && text[at] == '\\')
      ++at;
    else if (triple ? text.compare(at, 3, std::string(3, quote)) == 0 : text[at] == quote || text[at] == '\n')
      return at + (triple ? 3 : 1);
  return at;
}

/// Line in which brackets, or the dots of a key, go deeper than that; 0: none.
int too_deep(const std::string &text)
{
  int line = 1, depth = 0, dots = 0;
  for (std::size_t i = 0; i < text.size();)
  {
    const char c = text[i];
    if (c == '"' || c == '\'')
    {
      const std::size_t next = behind_string(text, i);
      line += int(std::count(text.begin() + long(i), text.begin() + long(std::min(next, text.size())), '\n'));
      i = next;
      continue;
    }
    if (c == '#')
      i = std::min(text.find('\n', i), text.size());
    else
      ++i;
    depth += (c == '[' || c == '{') - (c == ']' || c == '}');
    dots = c == '.' ? dots + 1 : c == '\n' || c == '=' || c == ',' ? 0 : dots;
    if (depth > deepest || dots > deepest)
      return line;
    line += c == '\n';
  }
  return 0;
}

/**
 * Locations of values in the text.  A location() of toml11 counts the lines before its value each time, which would
 * make reading quadratic in the length of the file; this class finds all ends of lines once and each line by bisection.
 */
class Places
{
public:
  explicit Places(const std::string &text) : text_(text)
  {
    for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 1))
      ends_.push_back(i);
  }

  /// Byte of the text at which the value begins; 0 of one that is not written there.
  std::size_t begin(const toml::value &value) const
  {
    const auto *written = dynamic_cast<const toml::detail::region *>(toml::detail::get_region(value));
    return written ? std::size_t(written->first() - written->begin()) : 0;
  }

  int line(const toml::value &value) const
  {
    return 1 + int(std::lower_bound(ends_.begin(), ends_.end(), begin(value)) - ends_.begin());
  }

  /// The very characters of a real number, so that who passes them on loses no digit; without "_", which formulas lack.
  std::string written_number(const toml::value &value) const
  {
    const auto       *written = toml::detail::get_region(value);
    const std::string text    = written ? text_.substr(std::min(begin(value), text_.size()), written->size()) : "";
    char             *end     = nullptr;
    const bool        is_it   = !text.empty() && std::strtod(text.c_str(), &end) == value.as_floating() && *end == '\0';
    return is_it ? text : exact_text(value.as_floating());
  }

private:
  const std::string       &text_;
  std::vector<std::size_t> ends_; ///< of lines
};

/// Entries in the order of the file; toml11 keeps none.
std::vector<const toml::table::value_type *> in_order(const toml::table &table, const Places &places)
{
  std::vector<std::tuple<std::size_t, std::string, const toml::table::value_type *>> placed;
  for (const auto &entry : table)
    placed.emplace_back(places.begin(entry.second), entry.first, &entry);
  std::sort(placed.begin(), placed.end());
  std::vector<const toml::table::value_type *> entries;
  for (const auto &[begin, key, entry] : placed)
    entries.push_back(entry);
  return entries;
}

SceneNode converted(const toml::value &value, const Places &places, const Place &place, const std::string &folder)
{
  SceneNode node;
  node.place  = place;
  node.folder = folder;
  if (place.line > 0)
    node.place.line = places.line(value);

  switch (value.type())
  {
  case toml::value_t::table:
    for (const auto *entry : in_order(value.as_table(), places))
      node.entries.emplace_back(entry->first, converted(entry->second, places, place, folder));
    break;
  case toml::value_t::array:
    node.type = Type::array;
    for (const auto &element : value.as_array())
      node.elements.push_back(converted(element, places, place, folder));
    break;
  case toml::value_t::string:
    node.type = Type::text;
    node.text = value.as_string().str;
    break;
  case toml::value_t::integer:
    node.type   = Type::integer;
    node.number = static_cast<double>(value.as_integer());
    node.text   = std::to_string(value.as_integer());
    break;
  case toml::value_t::floating:
    node.type   = Type::real;
    node.number = value.as_floating();
    node.text   = places.written_number(value);
    if (std::abs(node.number) == std::numeric_limits<double>::max()) // what toml11 reads of 1e400
      node.place.fail("a number is beyond 1.8e308, the largest that a computer takes; write a smaller one");
    break;
  case toml::value_t::boolean:
    node.type    = Type::boolean;
    node.boolean = value.as_boolean();
    node.text    = node.boolean ? "true" : "false";
    break;
  default:
    node.type = Type::date;
    node.text = "a date";
  }
  return node;
}

toml::value parsed(const std::string &text, const std::string &file)
{
  std::istringstream in(text);
  return toml::parse(in, file);
}

/// A text as nodes; toml::exception where it is not TOML.
SceneNode node_of(const std::string &text, const Place &place, const std::string &folder)
{
  return converted(parsed(text, place.file), Places(text), place, folder);
}

} // namespace

SceneNode parse_toml_text(const std::string &text, const std::string &name, const std::string &folder)
{
  const auto fail = [&](int line, const std::string &what) {
    throw std::invalid_argument(Place{name, line}.text() + ": " + what);
  };
  if (const int line = too_deep(text); line > 0)
    fail(line, "tables and arrays stand in each other more than " + std::to_string(deepest) +
                   " deep here; a scene needs six at most");
  toml::value root;
  try
  {
    root = parsed(text, name);
  }
  catch (const toml::exception &e)
  {
    auto hint = hint_of_reason(e.what());
    if (hint.empty())
      hint = toml_hint(line_of(text, e.location().line()));
    if (hint.empty())
      hint = hint_of_place(e.what());
    fail(e.location().line(), "is not TOML here: " + (hint.empty() ? first_line(e.what()) : hint));
  }
  catch (const std::exception &e)
  {
    fail(0, std::string("is not a TOML file: ") + first_line(e.what()));
  }
  return converted(root, Places(text), Place{name, 1}, folder);
}

SceneNode parse_toml_file(const std::string &path)
{
  const auto fail = [&](const std::string &what) { throw std::invalid_argument(path + ": " + what); };
  if (!fem::names_something(path))
    fail("there is no such scene file; give the path of a .toml file");
  if (const std::string other = fem::other_than_file(path); !other.empty() && other != "a pipe") // of a shell
    fail("is " + other + "; give the path of a .toml file");
  std::ifstream in(path, std::ios::binary);
  if (!in)
    fail("cannot be read; check its permissions");
  constexpr std::size_t largest_text = 64000000;   // bytes
  std::string           text, part(1 << 16, '\0'); // of a pipe no length is known
  while (text.size() <= largest_text && in.read(part.data(), std::streamsize(part.size())).gcount() > 0)
    text.append(part, 0, std::size_t(in.gcount()));
  if (in.bad())
    fail("cannot be read");
  if (text.size() > largest_text)
    fail("has more than " + std::to_string(largest_text / 1000000) + " MB; is it a scene?");
  if (const auto [line, hint] = hint_of_bytes(text); !hint.empty())
    throw std::invalid_argument(Place{path, line}.text() + ": " + hint);
  return parse_toml_text(text, path, std::filesystem::absolute(path).parent_path().lexically_normal().string());
}

std::optional<SceneNode> parse_toml_value(const std::string &text, const Place &place, const std::string &folder)
{
  if (text.find('\n') != std::string::npos || too_deep(text) > 0)
    return std::nullopt;
  try
  {
    SceneNode root = node_of("value = " + text + "\n", place, folder);
    return std::move(root.entries.at(0).second);
  }
  catch (const std::exception &)
  {
    return std::nullopt;
  }
}

} // namespace gestell::apps

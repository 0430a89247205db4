#include "apps/scene/file/toml_text.h"

#include "apps/scene/file/toml_hint.h"
#include "fem/values/named_file.h"
#include "fem/values/number_text.h"
#include "fem/values/trimmed.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace gestell::apps
{
namespace
{

using Type = SceneNode::Type;

std::string line_of(const std::string &text, int number)
{
  std::istringstream in(text);
  std::string        line;
  for (int i = 0; i < number && std::getline(in, line); ++i)
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

/// Converts locations of the parser, line and UTF-8 character, to bytes of the text; fast for ascending locations.
class PlacesInText
{
public:
  explicit PlacesInText(const std::string &text) : text_(text)
  {
    for (std::size_t i = text.find('\n'); i != std::string::npos; i = text.find('\n', i + 1))
      lines_.push_back(i + 1);
  }

  /// A real number as written, so that no digit is lost; all digits of its value if formulas cannot read it
  /// ("1_000.5").
  std::string written_number(const toml::value<double> &value)
  {
    const std::size_t begin = byte(value.source().begin), end = byte(value.source().end);
    const std::string text = text_.substr(begin, end - begin);
    char             *last = nullptr;
    const bool        same = !text.empty() && std::strtod(text.c_str(), &last) == value.get() && *last == '\0';
    return same ? text : exact_text(value.get());
  }

private:
  std::size_t byte(const toml::source_position &place)
  {
    if (place.line < 1 || place.line > lines_.size())
      return text_.size();
    if (place.line != line_ || place.column < column_)
    {
      line_   = place.line;
      column_ = 1;
      byte_   = lines_[line_ - 1];
    }
    for (; column_ < place.column && byte_ < text_.size(); ++column_)
      do
        ++byte_;
      while (byte_ < text_.size() && (static_cast<unsigned char>(text_[byte_]) & 0xC0) == 0x80);
    return byte_;
  }

  const std::string       &text_;
  std::vector<std::size_t> lines_{0}; ///< byte at which each begins
  toml::source_index       line_ = 0, column_ = 0;
  std::size_t              byte_ = 0; ///< of the last place
};

/// Entries in the order of the file; the parser sorts them by key.
auto in_order(const toml::table &table)
{
  std::vector<std::pair<const toml::key *, const toml::node *>> entries;
  for (const auto &[key, value] : table)
    entries.emplace_back(&key, &value);
  const auto place = [](const auto &entry)
  {
    const toml::source_position &begin = entry.first->source().begin;
    return std::pair(begin.line, begin.column);
  };
  std::sort(entries.begin(), entries.end(), [&](const auto &a, const auto &b) { return place(a) < place(b); });
  return entries;
}

SceneNode converted(const toml::node &value, PlacesInText &places, const Place &place, const std::string &folder)
{
  SceneNode node;
  node.place  = place;
  node.folder = folder;
  if (place.line > 0)
    node.place.line = std::max(1, int(value.source().begin.line));

  switch (value.type())
  {
  case toml::node_type::table:
    for (const auto &[key, entry] : in_order(*value.as_table()))
      node.entries.emplace_back(key->str(), converted(*entry, places, place, folder));
    break;
  case toml::node_type::array:
    node.type = Type::array;
    for (const toml::node &element : *value.as_array())
      node.elements.push_back(converted(element, places, place, folder));
    break;
  case toml::node_type::string:
    node.type = Type::text;
    node.text = value.as_string()->get();
    break;
  case toml::node_type::integer:
    node.type   = Type::integer;
    node.number = static_cast<double>(value.as_integer()->get());
    node.text   = std::to_string(value.as_integer()->get());
    break;
  case toml::node_type::floating_point:
    node.type   = Type::real;
    node.number = value.as_floating_point()->get();
    node.text   = places.written_number(*value.as_floating_point());
    break;
  case toml::node_type::boolean:
    node.type    = Type::boolean;
    node.boolean = value.as_boolean()->get();
    node.text    = node.boolean ? "true" : "false";
    break;
  default:
    node.type = Type::date;
    node.text = "a date";
  }
  return node;
}

/// A text as nodes.
/// @throws toml::parse_error where it is not TOML
SceneNode node_of(const std::string &text, const Place &place, const std::string &folder)
{
  PlacesInText places(text);
  return converted(toml::parse(text), places, place, folder);
}

} // namespace

SceneNode parse_toml_text(const std::string &text, const std::string &name, const std::string &folder)
{
  const auto complaint = [&](int line, const std::string &what) {
    return std::invalid_argument(Place{name, line}.text() + ": " + what);
  };
  if (const int line = too_deep(text); line > 0)
    throw complaint(line, "tables and arrays are nested more than " + std::to_string(deepest) +
                              " deep here; a scene needs at most six");
  try
  {
    return node_of(text, Place{name, 1}, folder);
  }
  catch (const toml::parse_error &error)
  {
    const std::string reason(error.description());
    int               line = int(error.source().begin.line);
    if (const std::string hint = hint_of_large_number(reason); !hint.empty())
      throw complaint(line, hint);
    const auto begins_head = [&](int i) { return trimmed(line_of(text, i)).compare(0, 1, "[") == 0; };
    if (reason.find("parsing table header") != std::string::npos && !begins_head(line) && begins_head(line - 1))
      --line; // its end has been read
    throw complaint(line, "is not valid TOML here: " + toml_hint(line_of(text, line), reason));
  }
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
  if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) // a byte order mark
    text.erase(0, 3);
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

#include "apps/scene/file/toml_hint.h"

#include "fem/values/trimmed.h"

#include <algorithm>
#include <regex>

namespace gestell::apps
{
namespace
{

/// Longer lines get no hint: std::regex needs stack for each letter, and time that grows with powers of their number.
constexpr std::size_t longest_judged = 120;

/// The line without its comment and without the contents of its quotes.
std::string bare(const std::string &line)
{
  std::string result;
  char        quote = '\0';
  for (const char c : line)
  {
    if (!quote && c == '#')
      break;
    if (!quote || c == quote)
      result += c;
    if (quote ? c == quote : c == '"' || c == '\'')
      quote = quote ? '\0' : c;
  }
  return result;
}

std::string hint_of_header(const std::string &header)
{
  static const std::regex with_spaces(R"(^\[+(.*\.)?([^".\]]*[^".\]A-Za-z0-9_-][^".\]]*)\]+$)");
  std::smatch             parts;
  if (std::regex_match(header, parts, with_spaces))
    return "a name with characters other than letters, digits, _ and - needs quotes: [" + parts[1].str() + "\"" +
           trimmed(parts[2]) + "\"]";
  return header.back() == ']' ? "" : "a table header ends with ]";
}

std::string hint_of_value(const std::string &value)
{
  static const std::regex comma(R"(^([-+]?\d+),(\d+(?:[eE][-+]?\d+)?)\s*([A-Za-z%\x80-\xff][^,]*)?$)");
  static const std::regex no_zero(R"((^|[\[{,\s])[-+]?(\.\d+|\d+\.(?=[\s,\]}]|$)))");
  static const std::regex with_unit(R"((^|[\[{,=]\s*)([-+]?[\d.]+([eE][-+]?\d+)?\s*[A-Za-z%\x80-\xff(*/^+][^,\]}]*))");
  static const std::regex word(R"(^[A-Za-z_\x80-\xff][^\[\]{},="']*$)");
  static const std::regex remark(R"(^[^"']*(//|;).*$)");
  std::smatch             parts;
  if (value.empty())
    return "a value is missing after the =";
  if (std::regex_match(value, parts, comma))
    return "write a decimal point: " +
           (parts[3].length() == 0 ? parts[1].str() + "." + parts[2].str()
                                   : "\"" + parts[1].str() + "." + parts[2].str() + " " + parts[3].str() + "\"");
  if (std::regex_match(value, remark))
    return "a comment begins with #, and a line has no end character";
  if (std::regex_search(value, parts, no_zero))
    return "a number has digits on both sides of its point: 0.5, 5.0";
  if (std::regex_search(value, parts, with_unit))
    return "put a value with a unit, and an expression, in quotes: \"" + trimmed(parts[2]) + "\"";
  if (value == "True" || value == "False" || value == "TRUE" || value == "FALSE" || value == "yes" || value == "no")
    return "write true or false";
  if (std::regex_match(value, word))
    return "a string needs quotes: \"" + value + "\"";
  return "";
}

} // namespace

std::string toml_hint(const std::string &line)
{
  if (line.size() > longest_judged)
    return "";
  for (const std::string quote : {"“", "”", "„", "‘", "’", "«", "»"})
    if (bare(line).find(quote) != std::string::npos)
      return "quotes are \" or ', not " + quote;
  const std::string content = trimmed(bare(line));
  if (content.empty())
    return "";
  if (content.front() == '[')
    return hint_of_header(content);
  if (std::count(content.begin(), content.end(), '"') % 2 + std::count(content.begin(), content.end(), '\'') % 2 > 0)
    return "a quote opened here is not closed";
  const auto equals = content.find('=');
  if (equals == std::string::npos)
    return content.find(':') != std::string::npos ? "a key and its value are separated by =" : "";
  const std::string       key = trimmed(content.substr(0, equals));
  static const std::regex with_more(R"(^[^"'.]*[^"'.A-Za-z0-9_-][^"'.]*$)");
  if (std::regex_match(key, with_more))
    return "a key with characters other than letters, digits, _ and - needs quotes: \"" + key + "\"";
  return hint_of_value(trimmed(content.substr(equals + 1)));
}

namespace
{

/// The name that a line defines: the text in the brackets of a head, or before the =.
std::string defined_in(const std::string &line)
{
  const std::string content = trimmed(line);
  const bool        head    = content.compare(0, 1, "[") == 0;
  const std::size_t begin   = head ? content.find_first_not_of('[') : 0;
  const std::size_t end     = content.find(head ? ']' : '=');
  return begin < end && end != std::string::npos ? trimmed(content.substr(begin, end - begin)) : "";
}

/// Hint for a key or table that is defined twice.
std::string hint_of_repetition(const std::string &line, const std::string &reason)
{
  static const std::regex twice(R"(cannot redefine existing ([a-z-]+)( '([A-Za-z0-9_.-]+)')?)");
  std::smatch             parts;
  const std::string       begin = reason.substr(0, 2 * longest_judged);
  if (!std::regex_search(begin, parts, twice))
    return "";
  const std::string own = defined_in(line); // the reason repeats letters after a quote
  const std::string name =
      parts[3].length() == 0 || own.find_first_of("'\"") != std::string::npos ? own : parts[3].str();
  const std::string type = parts[1];
  const bool        head = trimmed(line).compare(0, 1, "[") == 0;
  if (type == "table" && trimmed(line).compare(0, 2, "[[") == 0)
    return "[" + name + "] is a single table above; double brackets are for a list of tables";
  if (reason.find(" as table") != std::string::npos || reason.find(" as array-of-tables") != std::string::npos ||
      reason.find(" as dotted") != std::string::npos)
    return name + ": the same name is used above for another value (" + type + "); it cannot also be a table";
  if (type == "table")
    return head ? "[" + name + "] is defined twice in the file; put all its keys under one heading"
                : "'" + name + "' is already a table above";
  return "the key '" + name + "' is defined twice in this table; remove one of them";
}

/// Hint from the reason only, if the line itself gives none.
std::string hint_of_place(const std::string &reason)
{
  if (reason.find("expected comma or closing ']'") != std::string::npos)
    return "an array above is not closed; write it as [value, value]";
  if (reason.find("end-of-file") != std::string::npos)
    return "the file ends inside an array, a table or a string; close it with ], } or quotes";
  return reason.substr(reason.find(": ") + 2);
}

} // namespace

std::string toml_hint(const std::string &line, const std::string &reason)
{
  for (const std::string &hint : {hint_of_repetition(line, reason), toml_hint(line)})
    if (!hint.empty())
      return hint;
  return hint_of_place(reason);
}

std::string hint_of_large_number(const std::string &reason)
{
  if (reason.find("could not be interpreted as a value") != std::string::npos)
    return "a number exceeds 1.8e308, the largest possible value; write a smaller one";
  if (reason.find("not representable in 64 bits") != std::string::npos ||
      reason.find("exceeds length limit") != std::string::npos)
    return "a number has too many digits; write it with an exponent, such as 9.2e18";
  return "";
}

namespace
{

int line_at(const std::string &text, std::size_t place)
{
  return 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(place), '\n'));
}

/// Number of bytes of the character at `at`; 0 if no UTF-8 character begins there.
std::size_t utf8_length(const std::string &text, std::size_t at)
{
  const auto        first  = static_cast<unsigned char>(text[at]);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  for (std::size_t k = 1; k < length; ++k)
    if (at + k >= text.size() || (static_cast<unsigned char>(text[at + k]) & 0xC0) != 0x80)
      return 0;
  return length;
}

} // namespace

std::pair<int, std::string> hint_of_bytes(const std::string &text)
{
  const std::string begin = text.substr(0, 2);
  if (begin == "\xFF\xFE" || begin == "\xFE\xFF" || text.substr(0, 256).find('\0') != std::string::npos)
    return {1, "is in UTF-16 or is not text; save it in the encoding UTF-8"};
  if (text.compare(0, 10, "ISO-10303-") == 0)
    return {1,
            "is a STEP file, not a scene; 'gestell mesh FILE' lists its faces, and a scene refers to it by frame.cad"};
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t length = utf8_length(text, at);
    if (length == 0)
      return {line_at(text, at), "has a character that is not UTF-8 (Latin-1 or Windows?); save the file as UTF-8"};
    at += length;
  }
  return {0, ""};
}

} // namespace gestell::apps

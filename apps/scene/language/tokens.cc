#include "apps/scene/language/tokens.h"

#include "fem/values/number_text.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <stdexcept>
#include <system_error>

namespace gestell::apps
{
namespace
{

bool is_digit(unsigned char c)
{
  return std::isdigit(c);
}

/// Common non-ASCII characters, and their meaning.
std::string in_ascii(const std::string &character)
{
  static const std::map<std::string, std::string> meanings = {
      {"·", "*"},      {"⋅", "*"},      {"×", "*"},
      {"−", "-"},      {"π", "pi"},     {"μ", "µ"},       // a Greek letter and the sign of micro
      {"\u00a0", " "}, {"\u2009", " "}, {"\u202f", " "}}; // spaces that do not break a line
  const auto found = meanings.find(character);
  return found == meanings.end() ? character : found->second;
}

/// The plain character of a superscript digit or sign; empty for other characters.
std::string lowered(const std::string &character)
{
  static const std::map<std::string, std::string> raised = {{"⁻", "-"}, {"⁺", "+"}, {"⁰", "0"}, {"¹", "1"},
                                                            {"²", "2"}, {"³", "3"}, {"⁴", "4"}, {"⁵", "5"},
                                                            {"⁶", "6"}, {"⁷", "7"}, {"⁸", "8"}, {"⁹", "9"}};
  const auto                                      found  = raised.find(character);
  return found == raised.end() ? "" : found->second;
}

/// A character of UTF-8, as it is read.
struct Character
{
  std::string typed, meaning;
};

/// The character at `begin`; empty past the end of the text.
Character character_at(const std::string &text, std::size_t begin)
{
  if (begin >= text.size())
    return {};
  std::size_t end = begin + 1;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u)
    ++end;
  const std::string typed = text.substr(begin, end - begin);
  return {typed, in_ascii(typed)};
}

bool begins_name(const std::string &c)
{
  return c == "µ" || (c.size() == 1 && (std::isalpha(static_cast<unsigned char>(c[0])) || c[0] == '_'));
}
bool continues_name(const std::string &c)
{
  return begins_name(c) || (c.size() == 1 && is_digit(c[0]));
}

/// Length of the number at `begin`: digits, one dot, and an exponent if digits follow its e.
std::size_t number_length(const std::string &text, std::size_t begin)
{
  std::size_t i   = begin;
  const auto  run = [&]
  {
    const std::size_t start = i;
    while (i < text.size() && is_digit(text[i]))
      ++i;
    return i - start;
  };
  std::size_t digits = run();
  if (i < text.size() && text[i] == '.')
    ++i, digits += run();
  if (digits == 0)
    return 0;
  const std::size_t mantissa = i;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E'))
  {
    ++i;
    if (i < text.size() && (text[i] == '+' || text[i] == '-'))
      ++i;
    if (run() == 0)
      i = mantissa;
  }
  return i - begin;
}

double number(const std::string &text, const std::string &digits)
{
  double     value = 0.;
  const auto read  = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (read.ec != std::errc() || !std::isfinite(value))
    throw std::invalid_argument("\"" + text + "\" has a number out of range: " + digits);
  return value;
}

/// Place, from 1, of the character that begins at a byte.
int place_of(const std::string &text, std::size_t byte)
{
  return 1 + static_cast<int>(n_letters(text.substr(0, byte)));
}

struct Raised
{
  std::vector<Token> tokens;
  std::size_t        length;
};

/// "⁻¹" as ^ - 1.
Raised raised_number(const std::string &text, std::size_t begin)
{
  Raised      raised{{{Token::symbol, "^"}}, 0};
  std::string digits;
  for (std::string typed = character_at(text, begin).typed; !lowered(typed).empty();
       typed             = character_at(text, begin + raised.length).typed)
    digits += lowered(typed), raised.length += typed.size();
  if (!is_digit(digits[0]))
  {
    raised.tokens.push_back({Token::symbol, digits.substr(0, 1)});
    digits.erase(0, 1);
  }
  if (digits.empty() || number_length(digits, 0) != digits.size())
    throw std::invalid_argument("\"" + text + "\" has a raised sign where a raised number is expected" +
                                character(place_of(text, begin)));
  raised.tokens.push_back({Token::number, digits, number(text, digits)});
  return raised;
}

} // namespace

std::string character(int place)
{
  return " (character " + std::to_string(place) + ")";
}

bool is_identifier(const std::string &name)
{
  if (name.empty() || is_digit(name[0]))
    return false;
  for (const char c : name)
    if (!continues_name(std::string(1, c)))
      return false;
  return true;
}

std::vector<Token> tokens_of(const std::string &text)
{
  std::vector<Token> tokens;
  const auto         add = [&](Token token, std::size_t begin)
  {
    token.place = place_of(text, begin);
    tokens.push_back(token);
  };
  for (std::size_t i = 0; i < text.size();)
  {
    const Character   next = character_at(text, i);
    const std::string c    = next.meaning;
    if (c.size() == 1 && std::isspace(static_cast<unsigned char>(c[0])))
    {
      i += next.typed.size();
      continue;
    }
    if (const auto length = number_length(text, i))
    {
      add({Token::number, text.substr(i, length), number(text, text.substr(i, length))}, i);
      i += length;
      continue;
    }
    if (begins_name(c))
    {
      const std::size_t begin = i;
      std::string       name;
      for (Character part = next; begins_name(part.meaning) || (!name.empty() && continues_name(part.meaning));
           part           = character_at(text, i))
        name += part.meaning, i += part.typed.size();
      add({Token::name, name}, begin);
      continue;
    }
    if (!lowered(c).empty())
    {
      const auto raised = raised_number(text, i);
      for (const Token &token : raised.tokens)
        add(token, i);
      i += raised.length;
      continue;
    }
    if (c == "°" || c == "%" || c == "pi")
    {
      add({Token::name, c}, i);
      i += next.typed.size();
      continue;
    }
    if (c.size() == 1 && std::string("+-*/^(),<>").find(c) != std::string::npos)
    {
      const bool or_equal = (c == "<" || c == ">") && i + 1 < text.size() && text[i + 1] == '=';
      add({Token::symbol, or_equal ? c + "=" : c}, i);
      i += next.typed.size() + or_equal;
      continue;
    }
    throw std::invalid_argument("\"" + text + "\" has '" + next.typed + "', which has no meaning in a value" +
                                character(place_of(text, i)));
  }
  add({}, text.size());
  return tokens;
}

} // namespace gestell::apps

#include "apps/scene/tokens.h"

#include "apps/scene/quantity.h"

#include <cctype>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <system_error>

namespace gestell::apps
{
namespace
{

bool begins_name(unsigned char c)
{
  return std::isalpha(c) || c == '_';
}
bool continues_name(unsigned char c)
{
  return std::isalnum(c) || c == '_';
}
bool is_digit(unsigned char c)
{
  return std::isdigit(c);
}

/// Characters beyond ASCII that engineers type, and what they stand for.
struct Typed
{
  std::string        text;
  std::vector<Token> tokens;
};
const std::vector<Typed> &typed_signs()
{
  static const std::vector<Typed> signs = {
      {"²", {{Token::symbol, "^"}, {Token::number, "2", 2.}}},
      {"³", {{Token::symbol, "^"}, {Token::number, "3", 3.}}},
      {"·", {{Token::symbol, "*"}}},
      {"°", {{Token::name, "°"}}},
      {"%", {{Token::name, "%"}}},
      {"µm", {{Token::name, "µm"}}},
      {"µs", {{Token::name, "µs"}}},
  };
  return signs;
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

/// Characters, not bytes: those of UTF-8 that continue one are not counted.
int characters_before(const std::string &text, std::size_t end)
{
  int n = 0;
  for (std::size_t i = 0; i < end; ++i)
    n += (static_cast<unsigned char>(text[i]) & 0xC0u) != 0x80u;
  return n;
}

} // namespace

std::string character(int place)
{
  return " (character " + std::to_string(place) + ")";
}

bool is_identifier(const std::string &name)
{
  if (name.empty() || !begins_name(name[0]))
    return false;
  for (const char c : name)
    if (!continues_name(c))
      return false;
  return true;
}

std::vector<Token> tokens_of(const std::string &text)
{
  std::vector<Token> tokens;
  const auto         add = [&](Token token, std::size_t begin)
  {
    token.place = 1 + characters_before(text, begin);
    tokens.push_back(token);
  };
  for (std::size_t i = 0; i < text.size();)
  {
    const char c = text[i];
    if (std::isspace(static_cast<unsigned char>(c)))
    {
      ++i;
      continue;
    }
    if (const auto length = number_length(text, i))
    {
      double     value = 0.;
      const auto read  = std::from_chars(text.data() + i, text.data() + i + length, value);
      if (read.ec != std::errc() || !std::isfinite(value))
        throw std::invalid_argument("\"" + text + "\" has a number out of range: " + text.substr(i, length));
      add({Token::number, text.substr(i, length), value}, i);
      i += length;
      continue;
    }
    if (begins_name(c))
    {
      std::size_t end = i;
      while (end < text.size() && continues_name(text[end]))
        ++end;
      add({Token::name, text.substr(i, end - i)}, i);
      i = end;
      continue;
    }
    if (std::string("+-*/^(),<>").find(c) != std::string::npos)
    {
      const bool or_equal = (c == '<' || c == '>') && i + 1 < text.size() && text[i + 1] == '=';
      add({Token::symbol, text.substr(i, or_equal ? 2 : 1)}, i);
      i += or_equal ? 2 : 1;
      continue;
    }
    const Typed *sign = nullptr;
    for (const auto &candidate : typed_signs())
      if (text.compare(i, candidate.text.size(), candidate.text) == 0)
        sign = &candidate;
    if (!sign)
      throw std::invalid_argument("\"" + text + "\" has '" + std::string(1, c) + "', which has no meaning in a value" +
                                  character(1 + characters_before(text, i)));
    for (const Token &token : sign->tokens)
      add(token, i);
    i += sign->text.size();
  }
  add({}, text.size());
  return tokens;
}

} // namespace gestell::apps

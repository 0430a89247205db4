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
      {"²", {{Token::symbol, "^", 0.}, {Token::number, "2", 2.}}},
      {"³", {{Token::symbol, "^", 0.}, {Token::number, "3", 3.}}},
      {"·", {{Token::symbol, "*", 0.}}},
      {"°", {{Token::name, "°", 0.}}},
      {"%", {{Token::name, "%", 0.}}},
      {"µm", {{Token::name, "µm", 0.}}},
      {"µs", {{Token::name, "µs", 0.}}},
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

} // namespace

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
      tokens.push_back({Token::number, text.substr(i, length), value});
      i += length;
      continue;
    }
    if (begins_name(c))
    {
      std::size_t end = i;
      while (end < text.size() && continues_name(text[end]))
        ++end;
      tokens.push_back({Token::name, text.substr(i, end - i), 0.});
      i = end;
      continue;
    }
    if (std::string("+-*/^(),").find(c) != std::string::npos)
    {
      tokens.push_back({Token::symbol, std::string(1, c), 0.});
      ++i;
      continue;
    }
    const Typed *sign = nullptr;
    for (const auto &candidate : typed_signs())
      if (text.compare(i, candidate.text.size(), candidate.text) == 0)
        sign = &candidate;
    if (!sign)
      throw std::invalid_argument("\"" + text + "\" has '" + std::string(1, c) + "', which has no meaning in a value");
    tokens.insert(tokens.end(), sign->tokens.begin(), sign->tokens.end());
    i += sign->text.size();
  }
  return tokens;
}

} // namespace gestell::apps

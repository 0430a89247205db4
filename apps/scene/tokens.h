#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

struct Token
{
  enum Kind
  {
    end,
    number,
    name,
    symbol
  };
  Kind        kind = end;
  std::string text;
  double      value = 0.;
};

/// Tokens of an expression: numbers, names, and one of + - * / ^ ( ) ,  ("·" is *, "²" is ^2, "³" is ^3).
/// @throws std::invalid_argument at any other character.
std::vector<Token> tokens_of(const std::string &text);

} // namespace gestell::apps

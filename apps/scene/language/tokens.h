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
  int         place = 0; ///< of its first character in the text, from 1
};

/// Tokens of an expression: numbers, names, and one of + - * / ^ ( ), < <= > >=; at the end one of kind `end`.  Common
/// non-ASCII signs are accepted: "·" and "×" for *, "⁻²" for ^-2, "π" for pi, either mu for "µ".
/// @throws std::invalid_argument at any other character.
std::vector<Token> tokens_of(const std::string &text);

/// True for a letter or underscore followed by letters, digits, underscores.
bool is_identifier(const std::string &name);

/// " (character 12)", the end of messages with a position in a text.
std::string character(int place);

} // namespace gestell::apps

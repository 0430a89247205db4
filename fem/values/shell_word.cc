#include "fem/values/shell_word.h"

namespace gestell::fem
{

std::string shell_word(const std::string &text)
{
  std::string word = "'";
  for (const char c : text)
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string typed_word(const std::string &text)
{
  static const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=+:,@%-";
  return !text.empty() && text.find_first_not_of(plain) == std::string::npos ? text : shell_word(text);
}

} // namespace gestell::fem

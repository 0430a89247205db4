#pragma once

#include <string>

namespace gestell
{

/// A string without surrounding blanks, tabulators and line ends.
inline std::string trimmed(const std::string &text)
{
  const char *const blank = " \t\r\n";
  const auto        from  = text.find_first_not_of(blank);
  return from == std::string::npos ? std::string() : text.substr(from, text.find_last_not_of(blank) - from + 1);
}

} // namespace gestell

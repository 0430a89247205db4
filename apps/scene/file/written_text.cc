#include "apps/scene/file/written_text.h"

#include "fem/values/number_text.h"

#include <cctype>
#include <cstdio>

namespace gestell::apps
{

std::string written_text(const std::string &text)
{
  std::string written = "\"";
  for (const char c : text)
    if (c == '"' || c == '\\')
      written += std::string("\\") + c;
    else if (std::iscntrl(static_cast<unsigned char>(c)) != 0)
    {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(static_cast<unsigned char>(c)));
      written += code;
    }
    else
      written += c;
  return written + '"';
}

std::string with_value(const std::string &text, double value)
{
  const bool plain = text.find_first_not_of("+-.0123456789eE") == std::string::npos;
  return plain ? text : text + ", which is " + short_text(value) + " in SI units";
}

} // namespace gestell::apps

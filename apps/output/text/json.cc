#include "apps/output/text/json.h"

#include "fem/values/number_text.h"

#include <cmath>
#include <cstdio>

namespace gestell::apps
{
namespace
{

/// Length of the well-formed UTF-8 character that starts at x[i], 0 if there is none (RFC 3629).
std::size_t utf8_length(const std::string &x, std::size_t i)
{
  const auto byte = [&](std::size_t k) -> unsigned { return k < x.size() ? static_cast<unsigned char>(x[k]) : 0u; };
  const auto tail = [&](std::size_t k) { return (byte(k) & 0xc0u) == 0x80u; };

  const unsigned a = byte(i), b = byte(i + 1);
  if (a < 0x80)
    return 1;
  if (a >= 0xc2 && a <= 0xdf && tail(i + 1))
    return 2;
  const bool overlong3 = a == 0xe0 && b < 0xa0, surrogate = a == 0xed && b >= 0xa0;
  if ((a & 0xf0u) == 0xe0 && tail(i + 1) && tail(i + 2) && !overlong3 && !surrogate)
    return 3;
  const bool overlong4 = a == 0xf0 && b < 0x90, too_large = a == 0xf4 && b >= 0x90;
  if (a >= 0xf0 && a <= 0xf4 && tail(i + 1) && tail(i + 2) && tail(i + 3) && !overlong4 && !too_large)
    return 4;
  return 0;
}

void append_escaped(std::string &out, char c)
{
  switch (c)
  {
  case '"':
    out += "\\\"";
    return;
  case '\\':
    out += "\\\\";
    return;
  case '\n':
    out += "\\n";
    return;
  case '\t':
    out += "\\t";
    return;
  case '\r':
    out += "\\r";
    return;
  }
  if (static_cast<unsigned char>(c) >= 0x20)
  {
    out += c;
    return;
  }
  char code[8];
  std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
  out += code;
}

} // namespace

std::string json_quoted(const std::string &x)
{
  std::string out = "\"";
  for (std::size_t i = 0; i < x.size();)
  {
    const std::size_t length = utf8_length(x, i);
    if (length == 1)
      append_escaped(out, x[i]);
    else
      out += length == 0 ? "\xef\xbf\xbd" : x.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  return out + '"';
}

void JsonWriter::start_member(const std::string &name)
{
  if (!has_members_.empty())
  {
    document_ += has_members_.back() ? ",\n" : "\n";
    document_.append(2 * has_members_.size(), ' ');
    has_members_.back() = true;
  }
  if (!name.empty())
    document_ += json_quoted(name) + ": ";
}

void JsonWriter::open(const std::string &name, char bracket)
{
  start_member(name);
  document_ += bracket;
  has_members_.push_back(false);
}

void JsonWriter::close(char bracket)
{
  const bool had_members = has_members_.back();
  has_members_.pop_back();
  if (had_members)
  {
    document_ += '\n';
    document_.append(2 * has_members_.size(), ' ');
  }
  document_ += bracket;
  if (has_members_.empty())
    document_ += '\n';
}

void JsonWriter::number(const std::string &name, double x)
{
  start_member(name);
  if (std::isfinite(x))
    append_exact(document_, x);
  else
    document_ += "null";
}

void JsonWriter::integer(const std::string &name, long long x)
{
  start_member(name);
  document_ += std::to_string(x);
}

void JsonWriter::text(const std::string &name, const std::string &x)
{
  start_member(name);
  document_ += json_quoted(x);
}

void JsonWriter::null(const std::string &name)
{
  start_member(name);
  document_ += "null";
}

void JsonWriter::boolean(const std::string &name, bool x)
{
  start_member(name);
  document_ += x ? "true" : "false";
}

} // namespace gestell::apps

#include "fem/values/number_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace gestell
{

void append_exact(std::string &text, double x)
{
  std::array<char, 32> buffer;
  const auto           end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x).ptr;
  text.append(buffer.data(), end);
}

std::string exact_text(double x)
{
  std::string text;
  append_exact(text, x);
  return text;
}

std::string short_text(double x, int digits)
{
  if (!std::isfinite(x))
    return std::isnan(x) ? "–" : (x > 0. ? "∞" : "−∞");
  std::array<char, 64> buffer;
  const double         size = std::abs(x);
  if (size >= 1e-3 && size < 1e6)
  {
    const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
    std::snprintf(buffer.data(), buffer.size(), "%.*f", std::clamp(digits - before, 0, 9), x);
  }
  else
    std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, x);
  std::string text = buffer.data();
  if (text.find('.') != std::string::npos && text.find('e') == std::string::npos)
  {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.')
      text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

std::string rounded(double value, int digits)
{
  std::ostringstream text;
  text.precision(digits);
  text << value;
  return text.str();
}

std::string percent(double share, int digits)
{
  return rounded(100. * share, digits) + " %";
}

std::string count_text(std::size_t n, const std::string &one, const std::string &many)
{
  return std::to_string(n) + " " + (n == 1 ? one : many.empty() ? one + "s" : many);
}

std::size_t n_letters(const std::string &text)
{
  // Continuation bytes of UTF-8 begin with the bits 10.
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; });
}

DisplayUnit display_unit(const std::string &si_unit, double magnitude)
{
  static const std::array<const char *, 9> takes_prefix = {"N", "N m", "m", "m/s", "J", "W", "Pa", "N/m", "N s/m"};
  struct Prefix
  {
    int         exponent;
    const char *letter;
  };
  static const std::array<Prefix, 6> prefixes = {{{-9, "n"}, {-6, "µ"}, {-3, "m"}, {3, "k"}, {6, "M"}, {9, "G"}}};

  const bool scales = std::find(takes_prefix.begin(), takes_prefix.end(), si_unit) != takes_prefix.end();
  if (!scales || !(magnitude > 0.) || !std::isfinite(magnitude))
    return {1., si_unit};

  // Numbers between 2 and 2000 read best: 1060 kN, not 1.06 MN.
  const int exponent = std::clamp(3 * static_cast<int>(std::floor(std::log10(magnitude / 2.) / 3.)), -9, 9);
  for (const Prefix &prefix : prefixes)
    if (prefix.exponent == exponent)
      return {std::pow(10., -exponent), prefix.letter + si_unit};
  return {1., si_unit};
}

} // namespace gestell

#include "coupling/frame/number_in_file.h"

#include <charconv>
#include <cstring>
#include <limits>
#include <string_view>

namespace gestell::coupling
{
namespace
{

/// 1e-400 is 0, 1e400 infinite.
double beyond_range(std::string_view number)
{
  const bool   small = number.find("e-") != number.npos || number.find("E-") != number.npos;
  const double size  = small ? 0. : std::numeric_limits<double>::infinity();
  return number[0] == '-' ? -size : size;
}

} // namespace

const char *read_number(const char *text, double &value)
{
  const char *from = text + std::strspn(text, " \t");
  if (*from == '+' && from[1] != '-')
    ++from;
  const auto [end, error] = std::from_chars(from, from + std::strlen(from), value);
  if (error == std::errc::result_out_of_range)
    value = beyond_range({from, std::size_t(end - from)});
  return end == from ? text : end;
}

} // namespace gestell::coupling

#include "coupling/frame/number_in_file.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <string_view>

namespace gestell::coupling
{
namespace
{

/// Value of a number outside the range of double: 1e-400 and 0.00...01 are 0, 1e400 and 100...0 infinite.  Its power of
/// ten decides: the position of its first nonzero digit plus the exponent.
double beyond_range(std::string_view number)
{
  const double      sign     = number[0] == '-' ? -1. : 1.;
  const std::size_t exponent = number.find_first_of("eE");
  const auto        mantissa = number.substr(0, exponent);
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size()), first = mantissa.find_first_of("123456789");
  double            power = first < point ? double(point - first) : -double(first - point);
  if (exponent != number.npos)
  {
    const std::string_view digits =
        number.substr(std::min(number.find_first_of("0123456789", exponent), number.size()));
    double value = 0.;
    for (const char digit : digits)
      value = std::min(10. * value + (digit - '0'), 1e300);
    power += number[exponent + 1] == '-' ? -value : value;
  }
  return sign * (power < 0. ? 0. : std::numeric_limits<double>::infinity());
}

} // namespace

const char *read_number(const char *text, double &value)
{
  const char *from = text + std::strspn(text, " \t");
  if (*from == '+' && from[1] != '-')
    ++from;
  const std::size_t length =
      std::strspn(from, "+-.0123456789eEinfatyINFATY"); // not to the end of a long line each time
  const auto [end, error] = std::from_chars(from, from + length, value);
  if (error == std::errc::result_out_of_range)
    value = beyond_range({from, std::size_t(end - from)});
  return end == from ? text : end;
}

} // namespace gestell::coupling

#include "tests/fuzz/mesh/mesh_mutation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <limits>
#include <random>
#include <utility>

namespace gestell::fuzz
{
namespace
{

/// The standard fixes the numbers of this engine, not those of its distributions.
class Dice
{
public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(engine_() % n); }

private:
  std::mt19937_64 engine_;
};

constexpr std::array<const char *, 24> extremes = {"0",
                                                   "-1",
                                                   "1",
                                                   "2",
                                                   "3",
                                                   "-0.5",
                                                   "1e308",
                                                   "-1e308",
                                                   "1e400",
                                                   "nan",
                                                   "-nan",
                                                   "inf",
                                                   "2147483647",
                                                   "2147483648",
                                                   "4294967295",
                                                   "-2147483648",
                                                   "1e-320",
                                                   "1e12",
                                                   "999999",
                                                   "1000000000",
                                                   "18446744073709551615",
                                                   "9223372036854775807",
                                                   "0x10",
                                                   ""};

using Range = std::pair<std::size_t, std::size_t>; ///< [begin, end)

Range piece(const std::string &text, Dice &dice)
{
  const std::size_t from = dice.below(text.size());
  return {from, std::min(text.size(), from + 1 + dice.below(1 + dice.below(200)))};
}

Range line(const std::string &text, Dice &dice)
{
  const std::size_t at = dice.below(text.size()), before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return {before == std::string::npos ? 0 : before + 1, std::min(text.find('\n', at), text.size() - 1) + 1};
}

/// From a line that begins with $, * or # to the next such.
Range section(const std::string &text, Dice &dice)
{
  const auto  begins = [&](std::size_t i) { return i == 0 || text[i - 1] == '\n'; };
  const auto  heads  = [&](std::size_t i) { return std::strchr("$*#ESO", text[i]) && begins(i); };
  std::size_t from   = dice.below(text.size());
  while (from > 0 && !heads(from))
    --from;
  std::size_t to = std::min(from + 1, text.size());
  while (to < text.size() && !heads(to))
    ++to;
  return {from, to};
}

void exchange(std::string &text, Range a, Range b)
{
  if (a.first > b.first)
    std::swap(a, b);
  if (a.second > b.first)
    return;
  const std::string first = text.substr(a.first, a.second - a.first), second = text.substr(b.first, b.second - b.first);
  text.replace(b.first, second.size(), first);
  text.replace(a.first, first.size(), second);
}

void replace_number(std::string &text, Dice &dice)
{
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) || c == '.' || c == '-'; };
  const auto from =
      std::find_if(text.begin() + static_cast<std::ptrdiff_t>(dice.below(text.size())), text.end(), is_digit);
  const auto to = std::find_if_not(from, text.end(), is_digit);
  text.replace(from, to, extremes[dice.below(extremes.size())]);
}

template <typename Number>
void put(std::string &text, std::size_t at, Number value)
{
  if (at + sizeof value <= text.size())
    std::memcpy(&text[at], &value, sizeof value);
}

void replace_bytes(std::string &text, Dice &dice)
{
  const std::size_t at = dice.below(text.size());
  switch (dice.below(7))
  {
  case 0:
    return put(text, at, std::numeric_limits<double>::quiet_NaN());
  case 1:
    return put(text, at, std::numeric_limits<double>::infinity());
  case 2:
    return put(text, at, 1e308);
  case 3:
    return put(text, at, std::int32_t(-1));
  case 4:
    return put(text, at, std::numeric_limits<std::int32_t>::max());
  case 5:
    return put(text, at, std::uint64_t(1) << dice.below(64));
  default:
    return put(text, at, std::int32_t(dice.below(300)));
  }
}

void change(std::string &text, const std::vector<std::string> &seeds, Dice &dice)
{
  if (text.empty())
    text = seeds[dice.below(seeds.size())];
  const std::string &other = seeds[dice.below(seeds.size())];
  const std::size_t  at    = dice.below(text.size());
  switch (dice.below(14))
  {
  case 0:
    text[at] = static_cast<char>(text[at] ^ (1 << dice.below(8)));
    break;
  case 1:
    text[at] = static_cast<char>(dice.below(256));
    break;
  case 2:
  {
    const auto [from, to] = piece(text, dice);
    text.erase(from, to - from);
    break;
  }
  case 3:
  {
    const auto [from, to] = piece(text, dice);
    text.insert(at, text.substr(from, to - from));
    break;
  }
  case 4:
  {
    const auto [from, to] = piece(other, dice);
    text.insert(at, other.substr(from, to - from));
    break;
  }
  case 5:
  {
    const auto [from, to] = line(text, dice);
    text.erase(from, to - from);
    break;
  }
  case 6:
  {
    const auto [from, to] = line(text, dice);
    text.insert(from, text.substr(from, to - from));
    break;
  }
  case 7:
    exchange(text, line(text, dice), line(text, dice));
    break;
  case 8:
    exchange(text, section(text, dice), section(text, dice));
    break;
  case 9:
    if (dice.below(4) == 0) // most cut files are refused at the first look
      text.resize(at);
    break;
  case 10:
    replace_bytes(text, dice);
    break;
  default:
    replace_number(text, dice);
  }
}

} // namespace

std::string mutated(const std::vector<std::string> &seeds, std::uint64_t number)
{
  Dice        dice(number);
  std::string text = seeds[dice.below(seeds.size())];
  for (std::size_t n = 1 + dice.below(6); n > 0; --n)
    change(text, seeds, dice);
  return text;
}

} // namespace gestell::fuzz

#include "tests/fuzz/mutation.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>

namespace gestell::fuzz
{
namespace
{

namespace fs = std::filesystem;

/// Numbers of std::mt19937, whose sequence the standard fixes; its distributions differ from library to library.
class Dice
{
public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  std::size_t below(std::size_t n) { return n == 0 ? 0 : engine_() % n; }

private:
  std::mt19937 engine_;
};

constexpr std::array<const char *, 22> extremes = {"0",
                                                   "-1",
                                                   "1",
                                                   "2147483647",
                                                   "2147483648",
                                                   "-2147483648",
                                                   "4294967296",
                                                   "99999999",
                                                   "1e308",
                                                   "-1e308",
                                                   "1e999",
                                                   "1e-999",
                                                   "9223372036854775807",
                                                   "18446744073709551616",
                                                   "nan",
                                                   "inf",
                                                   "-0",
                                                   "0.1.2",
                                                   "1e",
                                                   "1D+400",
                                                   "000000000000000000001",
                                                   "1000000000000"};
constexpr std::array<const char *, 10> litter   = {"\xef\xbb\xbf", "\r\n", "\n", "\"", "'", "(", "[", ",", "\xc3", "-"};

std::string piece(const std::string &text, Dice &dice)
{
  const std::size_t from = dice.below(text.size());
  return text.substr(from, 1 + dice.below(std::min<std::size_t>(text.size(), 60)));
}

/// [begin, end) of a line with its end.
std::pair<std::size_t, std::size_t> line_of(const std::string &text, Dice &dice)
{
  const std::size_t at = dice.below(text.size()), before = text.rfind('\n', at == 0 ? 0 : at - 1);
  const std::size_t begin = before == std::string::npos || before >= at ? 0 : before + 1;
  return {begin, std::min(text.find('\n', at), text.size() - 1) + 1};
}

/// A number of the text replaced.
void exchange_number(std::string &text, Dice &dice)
{
  const auto        is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  const std::size_t at       = dice.below(text.size());
  const auto        from     = std::find_if(text.begin() + std::ptrdiff_t(at), text.end(), is_digit);
  const auto        to       = std::find_if_not(from, text.end(), is_digit);
  text.replace(from, to, extremes[dice.below(extremes.size())]);
}

void change(std::string &text, const std::vector<std::string> &seeds, Dice &dice)
{
  if (text.empty())
    text = seeds[dice.below(seeds.size())];
  if (text.empty())
    text = "1";
  const std::size_t at     = dice.below(text.size());
  const auto [begin, end]  = line_of(text, dice);
  const std::string  line  = text.substr(begin, end - begin);
  const std::string &other = seeds[dice.below(seeds.size())];
  switch (dice.below(11))
  {
  case 0:
    text[at] = char(text[at] ^ (1 << dice.below(8)));
    break;
  case 1:
    text[at] = char(dice.below(256));
    break;
  case 2:
    text.erase(at, 1 + dice.below(20));
    break;
  case 3:
    text.insert(at, piece(text, dice));
    break;
  case 4:
    text.insert(at, other.empty() ? "" : piece(other, dice));
    break;
  case 5:
    text.erase(begin, end - begin);
    break;
  case 6:
    text.insert(begin, line);
    break;
  case 7:
    text.resize(at);
    break;
  case 8:
    text.insert(at, litter[dice.below(litter.size())]);
    break;
  case 9:
    text.insert(at, 1, '\0');
    break;
  default:
    exchange_number(text, dice);
  }
}

std::string content_of(const fs::path &file)
{
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

} // namespace

std::string mutation(const std::vector<std::string> &seeds, unsigned k)
{
  Dice        dice(k);
  std::string text = seeds[dice.below(seeds.size())];
  for (std::size_t n = 1 + dice.below(8); n > 0; --n)
    change(text, seeds, dice);
  return text;
}

std::vector<std::pair<std::string, std::string>> files_in(const std::string &folder)
{
  std::vector<std::pair<std::string, std::string>> files;
  std::error_code                                  none;
  for (const auto &entry : fs::directory_iterator(folder, none))
    files.emplace_back(entry.path().filename().string(), content_of(entry.path()));
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::string> seeds_of(const std::string &target, const std::string &source_folder)
{
  const std::string        place = source_folder + "/tests/fuzz/seeds/" + target;
  std::vector<std::string> seeds;
  if (target == "any_matrix")
    for (const char *kind : {"matrix_market", "petsc", "dmig", "calculix", "substructure", "harwell_boeing"})
      for (const auto &[name, content] : files_in(source_folder + "/tests/fuzz/seeds/" + kind))
        seeds.push_back(content);
  for (const auto &[name, content] : files_in(place))
    seeds.push_back(content);
  std::istringstream lines(content_of(place + ".txt"));
  for (std::string line; std::getline(lines, line);)
    seeds.push_back(line);
  return seeds;
}

} // namespace gestell::fuzz

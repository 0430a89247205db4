#include "coupling/exchange/text_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

const char *const text_of_program =
    "is not text: binary files of finite element programs are not read. Let the program write text: Nastran DMIG "
    "(EXTSEOUT(...,DMIGPCH), PARAM,EXTOUT,DMIGPCH), Ansys HBMAT with Form = ASCII or *EXPORT,...,MMF, "
    "CalculiX *FREQUENCY,SOLVER=MATRIXSTORAGE";

std::string contents(const std::string &name)
{
  std::ifstream file(name, std::ios::binary);
  if (!file)
    throw std::invalid_argument(name + ": cannot be read; check the path and its permissions");
  file.seekg(0, std::ios::end);
  std::string text(std::size_t(std::max<std::streamoff>(file.tellg(), 0)), '\0');
  file.seekg(0);
  file.read(text.data(), std::streamsize(text.size()));
  if (std::size_t(file.gcount()) != text.size())
    throw std::invalid_argument(name + ": cannot be read completely; check that it is a regular file");
  return text;
}

/// Writes an exponent as in C: D becomes e, and a sign within the number becomes e with the sign.
std::size_t spelled_for_c(std::string_view field, char *number)
{
  std::size_t n = 0;
  for (std::size_t i = field[0] == '+' ? 1 : 0; i < field.size(); ++i)
  {
    const char c = field[i], before = n > 0 ? number[n - 1] : 'e';
    if (c == 'd' || c == 'D' || c == 'E')
      number[n++] = 'e';
    else if ((c == '+' || c == '-') && n > 0 && before != 'e')
    {
      number[n++] = 'e';
      number[n++] = c;
    }
    else
      number[n++] = c;
    if (n > 2 && number[n - 1] == '+' && number[n - 2] == 'e') // from_chars takes no plus
      --n;
  }
  return n;
}

} // namespace

TextFile::TextFile(const std::string &name) : name_(name), text_(contents(name))
{
  constexpr std::size_t judged_bytes = 4096; // a head: zeros of binary files are in it
  if (std::string_view(text_).substr(0, judged_bytes).find('\0') != std::string_view::npos)
    throw std::invalid_argument(name + ": " + text_of_program);
}

bool TextFile::next()
{
  if (at_ >= text_.size())
    return false;
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  line_                 = std::string_view(text_).substr(at_, end - at_);
  if (!line_.empty() && line_.back() == '\r')
    line_.remove_suffix(1);
  at_ = end + 1;
  ++number_;
  return true;
}

void TextFile::restart()
{
  at_     = 0;
  number_ = 0;
  line_   = {};
}

void TextFile::fail(long number, std::string_view line, const std::string &what) const
{
  constexpr std::size_t shown_letters = 60; // of a line, in a message of one line
  std::string           shown(line.substr(0, shown_letters));
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return !std::isprint(c); }, '?');
  throw std::invalid_argument(name_ + ":" + std::to_string(number) + ": '" + shown +
                              (line.size() > shown_letters ? "..." : "") + "': " + what);
}

void TextFile::fail_at(long line, const std::string &what) const
{
  throw std::invalid_argument(name_ + ":" + std::to_string(line) + ": " + what);
}

void TextFile::fail_at_end(const std::string &what) const
{
  throw std::invalid_argument(name_ + ":" + std::to_string(number_) + ": the file ends here, but " + what);
}

double TextFile::real(std::string_view field, const char *what) const
{
  field = trimmed(field);
  if (field.empty())
    fail(std::string("expected ") + what);
  const auto value = real_of(field);
  if (!value)
    fail("'" + std::string(field) + "' is not a number; expected " + what);
  if (!std::isfinite(*value))
    fail("'" + std::string(field) + "' is not a finite number; the program that wrote it failed, or divided by zero");
  return *value;
}

long TextFile::whole(std::string_view field, const char *what) const
{
  const auto value = whole_of(field);
  if (!value)
    fail("'" + std::string(trimmed(field)) + "' is not an integer; expected " + what);
  return *value;
}

long TextFile::node(std::string_view field) const
{
  const long number = whole(field, "the number of a node");
  if (number < 1)
    fail("node " + std::to_string(number) + " is invalid: numbers of nodes start at 1; check the column");
  return number;
}

std::optional<double> real_of(std::string_view field)
{
  field                                = trimmed(field);
  constexpr std::size_t longest_number = 60; // letters: twice the length of a double in any notation
  if (field.empty() || field.size() > longest_number)
    return std::nullopt;
  char              number[2 * longest_number];
  const std::size_t n     = spelled_for_c(field, number);
  double            value = 0.;
  const auto [end, error] = std::from_chars(number, number + n, value);
  if (error == std::errc::result_out_of_range) // 1e-400 is 0, 1e400 no number
    return std::string_view(number, n).find("e-") != std::string_view::npos ? 0. : HUGE_VAL;
  return error == std::errc() && end == number + n ? std::optional(value) : std::nullopt;
}

std::optional<long> whole_of(std::string_view field)
{
  field = trimmed(field);
  if (!field.empty() && field[0] == '+')
    field.remove_prefix(1);
  long value              = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  return error == std::errc() && end == field.data() + field.size() ? std::optional(value) : std::nullopt;
}

std::string_view trimmed(std::string_view text)
{
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos)
    return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string capitals(std::string_view text)
{
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return char(std::toupper(c)); });
  return result;
}

bool begins(std::string_view text, std::string_view beginning)
{
  return capitals(text.substr(0, beginning.size())) == capitals(beginning);
}

std::vector<std::string_view> words_of(std::string_view line)
{
  std::vector<std::string_view> words;
  for (std::size_t at = 0;;)
  {
    at = line.find_first_not_of(" \t", at);
    if (at == std::string_view::npos)
      return words;
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
}

} // namespace gestell::coupling

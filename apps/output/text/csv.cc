#include "apps/output/text/csv.h"

#include "fem/values/number_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace gestell::apps
{

std::string csv_field(const std::string &text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

void CsvTable::add_rows(const std::vector<double> &numbers)
{
  constexpr std::size_t longest = 25; // "-1.2345678901234567e-123,"
  const std::size_t     n       = columns_ > 0 ? numbers.size() / columns_ * columns_ : 0;
  text_.reserve(text_.size() + longest * n);
  std::array<char, longest> field;
  for (std::size_t i = 0; i < n; ++i)
  {
    char *const end = std::to_chars(field.data(), field.data() + field.size(), numbers[i]).ptr;
    *end            = (i + 1) % columns_ == 0 ? '\n' : ',';
    text_.append(field.data(), end + 1);
  }
}

void CsvTable::number(double x)
{
  append_exact(text_, x);
  text_ += ',';
}

std::vector<std::string> heads_of(const std::vector<std::string> &names, const std::vector<std::string> &units)
{
  std::vector<std::string> heads;
  for (std::size_t i = 0; i < names.size(); ++i)
    heads.push_back(names[i] + " [" + units[i] + "]");
  return heads;
}

std::vector<std::optional<double>> unless_nan(const std::vector<double> &numbers)
{
  std::vector<std::optional<double>> fields;
  for (const double x : numbers)
    fields.push_back(std::isnan(x) ? std::nullopt : std::optional(x));
  return fields;
}

} // namespace gestell::apps

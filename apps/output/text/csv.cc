#include "apps/output/text/csv.h"

#include "apps/output/text/number_rows.h"
#include "fem/values/number_text.h"

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
  write_number_rows(numbers, columns_, [this](const char *piece, std::size_t length) { text_.append(piece, length); });
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

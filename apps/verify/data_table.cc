#include "apps/verify/data_table.h"

#include "apps/scene/file/csv_file.h"
#include "apps/scene/language/parse_quantity.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

DataTable texts_of(const CsvFile &csv)
{
  DataTable table{csv.name, csv.head, {}};
  for (const CsvFile::Line &line : csv.lines)
    table.rows.push_back(line.cells);
  return table;
}

} // namespace

std::size_t DataTable::column(const std::string &wanted) const
{
  const auto found = std::find(head.begin(), head.end(), wanted);
  if (found == head.end())
    throw std::invalid_argument(name + " has no column '" + wanted + "'" + suggestion(wanted, head));
  return static_cast<std::size_t>(found - head.begin());
}

DataTable DataTable::chosen(const std::map<std::string, std::string> &cells) const
{
  DataTable some{name, head, {}};
  for (const auto &row : rows)
    if (std::all_of(cells.begin(), cells.end(),
                    [&](const auto &cell) { return same_cell(row[column(cell.first)], cell.second); }))
      some.rows.push_back(row);
  return some;
}

DataTable DataTable::without(const std::string &of, const std::string &word) const
{
  DataTable         some{name, head, {}};
  const std::size_t j = column(of);
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(some.rows),
               [&](const auto &row) { return row[j] != word; });
  return some;
}

std::string DataTable::cell(std::size_t row, const std::string &wanted) const
{
  if (std::find(head.begin(), head.end(), wanted) != head.end())
    return rows[row][column(wanted)];
  bool       names_one = false;
  const auto number_in = [&](const std::string &of)
  {
    double     value = 0.;
    const auto found = std::find(head.begin(), head.end(), of);
    names_one        = names_one || found != head.end();
    return found != head.end() && is_number(rows[row][std::size_t(found - head.begin())], value)
               ? std::optional<Quantity>(Quantity{value})
               : std::nullopt;
  };
  try
  {
    const double value = parse_quantity(wanted, number_in, head).value;
    if (names_one)
      return exact_text(value);
    throw std::invalid_argument("it names none of them"); // "t" on its own would be a tonne
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(name + " has no column '" + wanted + "'" + suggestion(wanted, head) +
                                ", nor is that a formula of its columns: " + error.what());
  }
}

DataTable read_table(const std::string &file)
{
  return texts_of(read_csv(file));
}

DataTable table_of(const std::string &name, const std::string &csv)
{
  return texts_of(csv_of_text(name, csv));
}

bool is_number(const std::string &text, double &value)
{
  char *end = nullptr;
  value     = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && !std::isnan(value);
}

bool same_cell(const std::string &a, const std::string &b)
{
  double x = 0., y = 0.;
  if (a == b || !is_number(a, x) || !is_number(b, y))
    return a == b;
  return std::abs(x - y) <= 1e-9 * std::max({1e-3, std::abs(x), std::abs(y)});
}

} // namespace gestell::apps

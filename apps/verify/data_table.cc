#include "apps/verify/data_table.h"

#include "apps/scene/file/csv_file.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// Cells between commas; those in quotes may hold some.
std::vector<std::string> cells_of(const std::string &line)
{
  std::vector<std::string> cells(1);
  bool                     quoted = false;
  for (const char c : line)
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  for (std::string &cell : cells)
    if (const auto first = cell.find_first_not_of(' '); first != std::string::npos)
      cell.erase(0, first);
  return cells;
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

DataTable read_table(const std::string &file)
{
  const CsvFile csv = read_csv(file);
  DataTable     table{csv.name, csv.head, {}};
  for (const CsvFile::Line &line : csv.lines)
    table.rows.push_back(line.cells);
  return table;
}

DataTable table_of(const std::string &name, const std::string &csv)
{
  DataTable          table{name, {}, {}};
  std::istringstream text(csv);
  for (std::string line; std::getline(text, line);)
    if (table.head.empty())
      table.head = cells_of(line);
    else if (!line.empty())
      (table.rows.emplace_back() = cells_of(line)).resize(table.head.size());
  return table;
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

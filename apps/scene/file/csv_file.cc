#include "apps/scene/file/csv_file.h"

#include "coupling/frame/number_in_file.h"
#include "fem/values/trimmed.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{

std::vector<std::string> csv_cells(const std::string &line, char separator)
{
  std::vector<std::string> cells(1);
  bool                     quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (quoted && line.compare(i, 2, "\"\"") == 0)
      cells.back() += line[i++];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == separator && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[i];
  std::transform(cells.begin(), cells.end(), cells.begin(), trimmed);
  return cells;
}

namespace
{

CsvFile parsed(const std::string &name, std::istream &in)
{
  CsvFile table;
  table.name     = name;
  char separator = ',';
  int  number    = 0;
  for (std::string line; std::getline(in, line);)
  {
    ++number;
    if (number == 1 && line.rfind("\xef\xbb\xbf", 0) == 0)
      line.erase(0, 3); // the mark of UTF-8 that spreadsheets put first
    if (line.find('\0') != std::string::npos)
      throw std::invalid_argument(table.place(number) +
                                  "contains a zero byte (UTF-16, or not text); save the table as CSV in UTF-8");
    const std::string text = trimmed(line);
    if (text.empty() || text[0] == '#')
      continue;
    if (table.head.empty())
    {
      separator  = std::count(text.begin(), text.end(), ';') > std::count(text.begin(), text.end(), ',') ? ';' : ',';
      table.head = csv_cells(text, separator);
      table.head_number = number;
      continue;
    }
    table.lines.push_back({number, csv_cells(text, separator)});
    if (table.lines.back().cells.size() != table.head.size())
      throw std::invalid_argument(table.place(number) + "has " + std::to_string(table.lines.back().cells.size()) +
                                  " cells instead of " + std::to_string(table.head.size()) + ", one for each column");
  }
  if (table.head.empty())
    throw std::invalid_argument(name + ": is empty; its first line must name the columns");
  return table;
}

} // namespace

CsvFile read_csv(const std::string &name)
{
  std::ifstream in(name);
  if (!in)
    throw std::invalid_argument(name + ": cannot be read; check the path and its permissions");
  return parsed(name, in);
}

CsvFile csv_of_text(const std::string &name, const std::string &text)
{
  std::istringstream in(text);
  return parsed(name, in);
}

double CsvFile::number(const Line &line, std::size_t column) const
{
  const std::string &cell  = line.cells[column];
  double             value = 0.;
  const char *const  end   = coupling::read_number(cell.c_str(), value);
  if (cell.empty() || *end != '\0' || !std::isfinite(value))
    throw std::invalid_argument(place(line.number) + "column '" + head[column] + "': got '" + cell +
                                "'; it needs a number with a decimal point, such as 0.25");
  return value;
}

int CsvFile::integer(const Line &line, std::size_t column) const
{
  const std::string &cell  = line.cells[column];
  char              *end   = nullptr;
  const long         value = std::strtol(cell.c_str(), &end, 10);
  if (*end != '\0' || value < -1000000000 || value > 1000000000)
    throw std::invalid_argument(place(line.number) + "column '" + head[column] + "': got '" + cell +
                                "'; it needs an integer, or nothing");
  return int(value);
}

} // namespace gestell::apps

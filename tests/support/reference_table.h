#pragma once

#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::tests
{

/// One line of a table, by the names of its columns; empty where the table says nothing.
class ReferenceRow
{
public:
  explicit ReferenceRow(std::map<std::string, std::string> cells) : cells_(std::move(cells)) {}
  const std::string &operator[](const std::string &column) const { return cells_.at(column); }
  bool               has(const std::string &column) const { return !cells_.at(column).empty(); }
  double             number(const std::string &column) const { return std::stod(cells_.at(column)); }

private:
  std::map<std::string, std::string> cells_;
};

/// A table of tests/reference/numerics: comma-separated with a header line; cells may stand in quotes.
inline std::vector<ReferenceRow> read_reference(const std::string &file)
{
  const std::string path = std::string(GESTELL_SOURCE_DIR) + "/tests/reference/numerics/" + file;
  std::ifstream     in(path);
  if (!in)
    throw std::runtime_error("cannot read " + path);
  const auto split = [](const std::string &line)
  {
    std::vector<std::string> cells(1);
    bool                     quoted = false;
    for (const char c : line)
      if (c == '"')
        quoted = !quoted;
      else if (c == ',' && !quoted)
        cells.emplace_back();
      else if (c != '\r')
        cells.back() += c;
    return cells;
  };
  std::string line;
  std::getline(in, line);
  const auto                names = split(line);
  std::vector<ReferenceRow> rows;
  while (std::getline(in, line))
  {
    auto cells = split(line);
    cells.resize(names.size());
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < names.size(); ++i)
      row[names[i]] = cells[i];
    rows.emplace_back(std::move(row));
  }
  return rows;
}

} // namespace gestell::tests

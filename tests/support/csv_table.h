#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::tests
{

/// A .csv file with a header line, read whole.
class CsvTable
{
public:
  explicit CsvTable(const std::string &path)
  {
    std::ifstream file(path);
    if (!file)
      throw std::invalid_argument("cannot read " + path);
    for (std::string line; std::getline(file, line);)
    {
      std::vector<std::string> cells;
      std::istringstream       text(line);
      for (std::string cell; std::getline(text, cell, ',');)
        cells.push_back(cell);
      (header_.empty() ? header_ : rows_.emplace_back()) = cells;
    }
  }

  int                rows() const { return static_cast<int>(rows_.size()); }
  const std::string &text(int row, const std::string &column) const { return rows_.at(row).at(index(column)); }
  double             number(int row, const std::string &column) const { return std::stod(text(row, column)); }

  /// `column` in the row that holds `key` in `key_column`.
  double number(const std::string &key_column, const std::string &key, const std::string &column) const
  {
    for (int row = 0; row < rows(); ++row)
      if (text(row, key_column) == key)
        return number(row, column);
    throw std::invalid_argument("no row " + key);
  }

private:
  std::size_t index(const std::string &column) const
  {
    for (std::size_t i = 0; i < header_.size(); ++i)
      if (header_[i] == column)
        return i;
    throw std::invalid_argument("no column " + column);
  }

  std::vector<std::string>              header_;
  std::vector<std::vector<std::string>> rows_;
};

} // namespace gestell::tests

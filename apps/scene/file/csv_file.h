#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// A table of text: lines of cells, the first of them the head.  Cells are separated by commas or, if the head has more
/// of them, by semicolons; they may stand in double quotes, a quote in them doubled.  Empty lines and lines that begin
/// with # do not count.
struct CsvFile
{
  struct Line
  {
    int                      number; ///< in the file, from 1
    std::vector<std::string> cells;  ///< as many as the head has
  };
  std::string              name;
  int                      head_number = 1;
  std::vector<std::string> head;
  std::vector<Line>        lines;

  std::string place(int line) const { return name + ":" + std::to_string(line) + ": "; }
  /// A finite number.
  /// @throws std::invalid_argument with file, line and column.
  double number(const Line &line, std::size_t column) const;
  /// A whole number; an empty cell is 0.
  int integer(const Line &line, std::size_t column) const;
};

/// Cells of a line, without blanks around them; a doubled quote between quotes is one of the cell.
std::vector<std::string> csv_cells(const std::string &line, char separator = ',');

/// @throws std::invalid_argument if the file cannot be read, has no head or a line of another number of cells.
CsvFile read_csv(const std::string &file);
/// Of a text; `name` stands in messages in place of the file.
/// @throws std::invalid_argument as read_csv()
CsvFile csv_of_text(const std::string &name, const std::string &text);

} // namespace gestell::apps

#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// A table of text: a header line, then lines of cells.  Cells are separated by commas or, if the header has more of
/// them, by semicolons; they may be quoted with double quotes, with inner quotes doubled.  Empty lines and lines that
/// begin with # are skipped.
struct CsvFile
{
  struct Line
  {
    int                      number; ///< in the file, from 1
    std::vector<std::string> cells;  ///< as many as the header has
  };
  std::string              name;
  int                      head_number = 1;
  std::vector<std::string> head;
  std::vector<Line>        lines;

  std::string place(int line) const { return name + ":" + std::to_string(line) + ": "; }
  /// A finite number.
  /// @throws std::invalid_argument with file, line and column.
  double number(const Line &line, std::size_t column) const;
  /// An integer; an empty cell is 0.
  int integer(const Line &line, std::size_t column) const;
};

/// Cells of a line, without surrounding blanks; a doubled quote inside quotes is a quote character.
std::vector<std::string> csv_cells(const std::string &line, char separator = ',');

/// @throws std::invalid_argument if the file cannot be read, has no header or a line with another number of cells.
CsvFile read_csv(const std::string &file);
/// The same from a string; messages contain `name` in place of the file.
/// @throws std::invalid_argument as read_csv() does
CsvFile csv_of_text(const std::string &name, const std::string &text);

} // namespace gestell::apps

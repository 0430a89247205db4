#pragma once

#include "coupling/exchange/text_file.h"

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace gestell::coupling
{

/**
 * Cards of Nastran's bulk data, in the small field format (10 columns of 8), the large one (names that end with *,
 * columns of 16) or the free one (commas), with their continuations.  Comments ($) and what is before BEGIN BULK or
 * after ENDDATA are ignored, as are lines of other cards.
 */
class BulkCards
{
public:
  /// @param wanted  names of cards, in upper case.
  BulkCards(TextFile &file, std::set<std::string> wanted);

  /// Steps to the next requested card; false at the end.
  bool next();

  const std::string &name() const { return name_; } ///< in capitals, without *
  long               line() const { return line_; } ///< of its first line

  /// Fields after the name, blanks removed, line by line: 8 per line, or 4 per line of a large card.
  const std::vector<std::string_view> &fields() const { return fields_; }
  const std::vector<long>             &lines() const { return lines_; } ///< of each field

private:
  bool take_line();
  void add_fields();

  TextFile             &file_;
  std::set<std::string> wanted_;

  std::string                   name_;
  long                          line_ = 0;
  std::vector<std::string_view> fields_;
  std::vector<long>             lines_;
  bool                          has_line_ = false, ended_ = false;
};

} // namespace gestell::coupling

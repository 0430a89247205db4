#pragma once

#include "apps/verify/reference_case.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A table of text with named columns.
struct DataTable
{
  std::string                           name{};
  std::vector<std::string>              head{};
  std::vector<std::vector<std::string>> rows{};

  /// @throws std::invalid_argument with the columns there are
  std::size_t column(const std::string &name) const;
  /// Rows whose cells are those, as text or as numbers.
  DataTable chosen(const std::map<std::string, std::string> &cells) const;
  /// Rows whose cell of that column is another word.
  DataTable without(const std::string &column, const std::string &word) const;
  /// A cell, or the number that a formula of columns gives, such as "sqrt(re^2 + im^2)".
  /// @throws std::invalid_argument with the columns there are
  std::string cell(std::size_t row, const std::string &column) const;
};

/// @throws std::invalid_argument as read_csv()
DataTable read_table(const std::string &file);
/// Of a text as result files have it.
DataTable table_of(const std::string &name, const std::string &csv);

/// Both are the same text, or numbers that differ by rounding alone.
bool same_cell(const std::string &a, const std::string &b);

/// Nothing if the text is no number.
bool is_number(const std::string &text, double &value);

} // namespace gestell::apps

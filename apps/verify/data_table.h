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

  /// @throws std::invalid_argument with the existing columns
  std::size_t column(const std::string &name) const;
  /// Rows with these cells, compared as text or as numbers.
  DataTable chosen(const std::map<std::string, std::string> &cells) const;
  /// Rows whose cell in that column differs from `word`.
  DataTable without(const std::string &column, const std::string &word) const;
  /// A cell, or the number from a formula of columns, such as "sqrt(re^2 + im^2)".
  /// @throws std::invalid_argument with the existing columns
  std::string cell(std::size_t row, const std::string &column) const;
};

/// @throws std::invalid_argument as read_csv() does
DataTable read_table(const std::string &file);
/// From a string in the format of result files.
DataTable table_of(const std::string &name, const std::string &csv);

/// Whether both are the same text, or numbers that differ only by rounding.
bool same_cell(const std::string &a, const std::string &b);

/// False if the text is not a number.
bool is_number(const std::string &text, double &value);

} // namespace gestell::apps

#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace gestell::apps
{

/// A field of a row (RFC 4180): quoted if it contains a separator, a quote or a line end, with its quotes doubled.
std::string csv_field(const std::string &text);

/// Text of a CSV file: a header line, then one line per row.
class CsvTable
{
public:
  CsvTable() = default; ///< an empty file
  explicit CsvTable(const std::vector<std::string> &heads) : columns_(heads.size()) { add(heads); }

  /// A field is a number (in full precision), a boolean (1 or 0), a string, a list of fields, a std::variant, or a
  /// std::optional of these (empty: an empty field).
  template <class... Fields>
  void add(const Fields &...fields)
  {
    (field(fields), ...);
    if (!text_.empty())
      text_.back() = '\n';
  }
  /// Rows of numbers, one after the other; an incomplete last row is dropped.
  void add_rows(const std::vector<double> &numbers);

  operator std::string() const & { return text_; } ///< "" without column heads
  operator std::string() && { return std::move(text_); }

private:
  template <class T>
  void field(const T &x)
  {
    if constexpr (std::is_convertible_v<const T &, std::string>)
      text_ += csv_field(x) + ',';
    else if constexpr (std::is_integral_v<T>)
      text_ += std::to_string(x) + ',';
    else if constexpr (std::is_floating_point_v<T>)
      number(x);
    else
      for (const auto &own : x)
        field(own);
  }
  template <class T>
  void field(const std::optional<T> &x)
  {
    x ? field(*x) : void(text_ += ',');
  }
  template <class... Kinds>
  void field(const std::variant<Kinds...> &x)
  {
    std::visit([this](const auto &own) { field(own); }, x);
  }
  void number(double x);

  std::string text_;
  std::size_t columns_ = 0;
};

/// Column heads, "F_P [N]".
std::vector<std::string> heads_of(const std::vector<std::string> &names, const std::vector<std::string> &units);

/// Optionals of numbers; nan (unknown) becomes an empty field.
std::vector<std::optional<double>> unless_nan(const std::vector<double> &numbers);

} // namespace gestell::apps

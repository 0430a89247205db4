#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace gestell::apps
{

/// A field of a row (RFC 4180): in quotes where it holds a separator, a quote or a line end, its quotes doubled.
std::string csv_field(const std::string &text);

/// A table as a file holds it: a line of heads, then one line per row.
class CsvTable
{
public:
  CsvTable() = default; ///< no file
  explicit CsvTable(const std::vector<std::string> &heads) : columns_(heads.size()) { add(heads); }

  /// A field is a number, in full precision, a truth, 1 or 0, a text, a list of fields, a std::optional of these, empty
  /// where it holds nothing, or a std::variant.
  template <class... Fields>
  void add(const Fields &...fields)
  {
    (field(fields), ...);
    if (!text_.empty())
      text_.back() = '\n';
  }
  /// Rows of numbers, one after the other; what does not fill a row is left out.
  void add_rows(const std::vector<double> &numbers);

  operator std::string() const & { return text_; } ///< "" without heads
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

/// Heads of columns, "F_P [N]".
std::vector<std::string> heads_of(const std::vector<std::string> &names, const std::vector<std::string> &units);

/// Fields of numbers; nan, which is unknown, becomes an empty field.
std::vector<std::optional<double>> unless_nan(const std::vector<double> &numbers);

} // namespace gestell::apps

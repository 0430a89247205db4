#pragma once

#include "apps/output/describe/described.h"
#include "apps/output/text/csv.h"
#include "apps/output/text/html.h"

#include <variant>

namespace gestell::apps
{

/// A table of described values, one per row.  Members of described members have separate columns; lists have none.
struct DescribedTable
{
  using Cell = std::variant<std::string, double, long, bool>;
  struct Column
  {
    std::string name, unit; ///< "frequency_hz", "Hz"
    bool        numeric = true;
    std::string head() const; ///< "frequency [Hz]"
  };
  std::vector<Column>            columns;
  std::vector<std::vector<Cell>> rows;

  /// The table with columns renamed to the names used in existing files.
  DescribedTable renamed(const std::vector<std::pair<std::string, std::string>> &names) &&;

  CsvTable    csv() const;
  HtmlTable   shown() const; ///< numbers to five digits
  std::string html() const { return shown().scrolled_html(); }
  std::string terminal() const { return shown().terminal(); }
};

/// One row of a table.
struct TableRow
{
  DescribedTable                   &table;
  bool                              first;         ///< also adds the columns
  bool                              blank = false; ///< there is no value: empty fields
  std::string                       prefix{};
  std::vector<DescribedTable::Cell> cells{};

  template <class T>
  void operator()(const char *name, const T &value, const std::string &unit = "", const char * = "")
  {
    if constexpr (is_optional<T>)
    {
      const bool was = std::exchange(blank, blank || !value);
      (*this)(name, value.value_or(typename T::value_type{}), unit);
      blank = was;
    }
    else if constexpr (is_described<T>)
    {
      const std::string was = std::exchange(prefix, prefix + name + '_');
      describe(*this, value);
      prefix = was;
    }
    else if constexpr (is_pairs<T>)
    {
      const std::string was = std::exchange(prefix, prefix + name + ' ');
      for (const auto &[key, own] : value)
        (*this)(key.c_str(), own, unit);
      prefix = was;
    }
    else if constexpr (!is_list<T>)
      add(name, cell_of(value), unit);
  }
  template <class T>
  void maybe(bool is, const char *name, const T &value, const std::string &unit = "", const char * = "")
  {
    const bool was = std::exchange(blank, blank || !is);
    (*this)(name, value, unit);
    blank = was;
  }

private:
  template <class T>
  static DescribedTable::Cell cell_of(const T &value)
  {
    if constexpr (std::is_same_v<T, bool>)
      return value;
    else if constexpr (std::is_integral_v<T>)
      return long(value);
    else if constexpr (std::is_floating_point_v<T>)
      return double(value);
    else
      return std::string(value);
  }
  void add(const char *name, DescribedTable::Cell cell, const std::string &unit);
};

template <class T>
DescribedTable table_of(const std::vector<T> &items)
{
  DescribedTable table;
  T              none{};
  TableRow       heads{table, true};
  describe(heads, items.empty() ? none : items.front());
  for (const T &item : items)
  {
    TableRow row{table, false};
    describe(row, item);
    table.rows.push_back(std::move(row.cells));
  }
  return table;
}

} // namespace gestell::apps

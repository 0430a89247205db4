#include "apps/output/describe/described_table.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::apps
{

namespace
{

/// Five digits; eight of a number near one, as a growth per step, which is read by its distance from one.
std::string short_number(double x)
{
  constexpr double near_one = 0.01; // farther away, five digits leave three of the distance
  return std::isnan(x) ? "–" : short_text(x, std::abs(x - 1.) < near_one ? 8 : 5);
}

std::string cell_text(const DescribedTable::Cell &cell)
{
  if (const double *x = std::get_if<double>(&cell))
    return short_number(*x);
  if (const long *n = std::get_if<long>(&cell))
    return std::to_string(*n);
  if (const bool *truth = std::get_if<bool>(&cell))
    return *truth ? "yes" : "no";
  return std::get<std::string>(cell);
}

std::string with_unit(const std::string &text, const std::string &unit)
{
  return unit.empty() ? text : text + " [" + unit + "]";
}

/// Columns for readers where the name of the member is not a noun of the field; files keep the names.
const std::map<std::string, std::string> &readable_heads()
{
  static const std::map<std::string, std::string> heads = {{"t", "time"},
                                                           {"behind", "after"},
                                                           {"duration_over_period", "duration / T"},
                                                           {"rise_over_period", "rise time / T"},
                                                           {"fall_over_period", "fall time / T"},
                                                           {"fall_factor", "residual vibration ratio"},
                                                           {"strain_energy_in", "part with most strain energy"},
                                                           {"swing_hz", "observed frequency"},
                                                           {"seen_hz", "observed frequency"},
                                                           {"closed_hz", "frequency without clearance"},
                                                           {"mode_hz", "mode frequency"},
                                                           {"share", "share of the mode"},
                                                           {"sum_of_shares", "sum over all modes"},
                                                           {"stiffness_share", "stiffness ratio"},
                                                           {"modes_of", "system"},
                                                           {"number", "mode"},
                                                           {"growing_modes", "unstable modes"},
                                                           {"worst_hz", "most unstable frequency"},
                                                           {"step_that_works_s", "largest stable step"},
                                                           {"lowest_period_error", "period error of lowest mode"},
                                                           {"highest_period_error", "period error of highest mode"},
                                                           {"from_omega_h", "unstable from omega h"},
                                                           {"to_omega_h", "unstable to omega h"},
                                                           {"at_omega_h", "omega h of largest growth"}};
  return heads;
}

bool ends_with(const std::string &text, const std::string &end)
{
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

} // namespace

std::string DescribedTable::Column::head() const
{
  std::string text = name;
  for (const auto &[own, suffix] : {std::pair("Hz", "_hz"), std::pair("s", "_s")})
    if (unit == own && ends_with(text, suffix))
      text.resize(text.size() - std::string(suffix).size());
  std::replace(text.begin(), text.end(), '_', ' ');
  return with_unit(text, unit);
}

DescribedTable DescribedTable::renamed(const std::vector<std::pair<std::string, std::string>> &names) &&
{
  for (Column &column : columns)
    for (const auto &[name, other] : names)
      if (column.name == name)
        column.name = other;
  return std::move(*this);
}

CsvTable DescribedTable::csv() const
{
  std::vector<std::string> heads;
  for (const Column &column : columns)
    heads.push_back(column.head());
  CsvTable csv(heads);
  for (const auto &row : rows)
    csv.add(row);
  return csv;
}

HtmlTable DescribedTable::shown() const
{
  std::vector<std::string> heads;
  for (const Column &column : columns)
  {
    const auto own = readable_heads().find(column.name);
    heads.push_back((column.numeric ? "#" : "") +
                    (own == readable_heads().end() ? column.head() : with_unit(own->second, column.unit)));
  }
  HtmlTable table(heads);
  for (const auto &row : rows)
  {
    std::vector<HtmlTable::Cell> cells;
    for (const Cell &cell : row)
      cells.push_back(cell_text(cell));
    table.add(cells);
  }
  return table;
}

void TableRow::add(const char *name, DescribedTable::Cell cell, const std::string &unit)
{
  if (first)
    table.columns.push_back({prefix + name, unit, !std::holds_alternative<std::string>(cell)});
  cells.push_back(blank ? DescribedTable::Cell() : std::move(cell));
}

} // namespace gestell::apps

#include "apps/verify/integrator_maps.h"

#include "coupling/integration/stability/overshoot.h"
#include "coupling/integration/stability/stability.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using coupling::MethodOptions;
using Cells = std::vector<std::string>;

/// A row of the expected table, by columns.
struct MapRow
{
  const DataTable &table;
  std::size_t      i;

  const std::string &text(const std::string &column) const { return table.rows[i][table.column(column)]; }
  double             number(const std::string &column) const
  {
    double value = 0.;
    if (!is_number(text(column), value))
      throw std::invalid_argument(table.name + ": column '" + column + "' holds '" + text(column) + "', no number");
    return value;
  }
  coupling::TestOscillator oscillator() const { return {number("zeta"), number("omega_h")}; }
};

Cells radius(const MethodOptions &method, const MapRow &row)
{
  return {exact_text(coupling::spectral_radius(method, row.oscillator()))};
}

Cells period_and_damping(const MethodOptions &method, const MapRow &row)
{
  const auto step = coupling::step_properties(method, row.oscillator());
  if (std::isnan(step.period_elongation))
    return {"overdamped", "overdamped"};
  return {exact_text(step.period_elongation), exact_text(step.numerical_damping)};
}

/// How many rows above have the same method and damping.
std::size_t rank_of(const MapRow &row)
{
  std::size_t rank = 0;
  for (std::size_t j = 0; j < row.i; ++j)
    rank += row.text("method") == MapRow{row.table, j}.text("method") &&
            row.text("zeta") == MapRow{row.table, j}.text("zeta");
  return rank;
}

Cells interval(const MethodOptions &method, const MapRow &row)
{
  const auto        intervals = coupling::unstable_intervals(method, row.number("zeta"));
  const std::size_t rank      = rank_of(row);
  if (rank >= intervals.size())
    return {"none", "none"};
  return {exact_text(intervals[rank].from), exact_text(intervals[rank].to)};
}

Cells overshooting(const MethodOptions &method, const MapRow &row)
{
  const auto start =
      row.text("start") == "x0=1,v0=0" ? coupling::OscillatorStart::displaced : coupling::OscillatorStart::moving;
  const auto most = coupling::overshoot(method, {0., row.number("omega_h")}, start, coupling::FirstSteps::order_ramp);
  return {exact_text(most.displacement), exact_text(most.velocity)};
}

struct Map
{
  std::string              name;
  std::vector<std::string> columns;
  Cells (*cells)(const MethodOptions &method, const MapRow &row);
};

const std::vector<Map> &maps()
{
  static const std::vector<Map> all = {
      {"spectral radius", {"spectral radius"}, radius},
      {"period and damping", {"period elongation", "numerical damping"}, period_and_damping},
      {"unstable intervals", {"from", "to"}, interval},
      {"overshoot", {"displacement", "velocity"}, overshooting}};
  return all;
}

const Map &map_of(const std::string &name)
{
  std::vector<std::string> names;
  for (const Map &map : maps())
  {
    if (map.name == name)
      return map;
    names.push_back(map.name);
  }
  throw std::invalid_argument("there is no map '" + name + "' of integrators" + suggestion(name, names));
}

} // namespace

DataTable integrator_map(const std::string &name, const DataTable &expected,
                         const std::map<std::string, coupling::MethodOptions> &methods)
{
  const Map &map = map_of(name);
  DataTable  table{name, map.columns, {}};
  for (std::size_t i = 0; i < expected.rows.size(); ++i)
  {
    const MapRow row{expected, i};
    const auto   method = methods.find(row.text("method"));
    if (method == methods.end())
      throw std::invalid_argument(expected.name + " has a method '" + row.text("method") +
                                  "' that 'methods' does not name; name it there, or in 'methods_left_out' with the "
                                  "reason");
    table.rows.push_back(map.cells(method->second, row));
  }
  return table;
}

} // namespace gestell::apps

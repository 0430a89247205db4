#include "apps/output/tables/periodic_tables.h"

#include "apps/output/tables/basins_table.h"
#include "apps/output/tables/section_table.h"
#include "apps/output/text/csv.h"
#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

std::string parameter_head(const PeriodicResult &result)
{
  if (result.parameter.empty())
    return "parameter";
  return csv_field(result.parameter + (result.parameter_unit.empty() ? "" : " [" + result.parameter_unit + "]"));
}

std::string yes_no(const coupling::PeriodicSolution &solution)
{
  return !solution.stability_is_known() ? "" : solution.stable() ? "yes" : "no";
}

void append_parameter(const PeriodicResult &result, double value, std::string &csv)
{
  csv += ',';
  if (!result.parameter.empty())
    append_exact(csv, value);
}

} // namespace

std::string kind_of(const coupling::PeriodicSolution &solution)
{
  return solution.ratio > 1 ? "sub-harmonic 1/" + std::to_string(solution.ratio) : "periodic";
}

std::string solutions_csv(const PeriodicResult &result)
{
  std::string csv =
      "solution,branch," + parameter_head(result) + ",period [s],period ratio,residual,stable,largest multiplier,kind";
  if (!result.entries.empty())
    for (const SignalOrbit &signal : result.entries.front().signals)
    {
      for (const char *what : {" max", " min", " mean"})
        csv += ',' + csv_field(signal.name + what);
      for (std::size_t k = 1; k <= signal.amplitude.size(); ++k)
        csv += ',' + csv_field(signal.name + " a" + std::to_string(k)) + ',' +
               csv_field(signal.name + " phi" + std::to_string(k));
    }
  csv += '\n';
  int number = 0;
  for (const PeriodicEntry &entry : result.entries)
  {
    csv += std::to_string(++number) + ',' + std::to_string(entry.branch);
    append_parameter(result, entry.parameter, csv);
    append_exact(csv += ',', entry.solution.period);
    csv += ',' + std::to_string(entry.solution.ratio);
    append_exact(csv += ',', entry.solution.residual);
    csv += ',' + yes_no(entry.solution);
    append_exact(csv += ',', entry.solution.largest_multiplier());
    csv += ',' + kind_of(entry.solution);
    for (const SignalOrbit &signal : entry.signals)
    {
      for (const double x : {signal.max, signal.min, signal.mean})
        append_exact(csv += ',', x);
      for (std::size_t k = 0; k < signal.amplitude.size(); ++k)
      {
        append_exact(csv += ',', signal.amplitude[k]);
        append_exact(csv += ',', signal.phase[k]);
      }
    }
    csv += '\n';
  }
  return csv;
}

std::string multipliers_csv(const PeriodicResult &result)
{
  std::string csv    = "solution,re,im,abs\n";
  int         number = 0;
  for (const PeriodicEntry &entry : result.entries)
  {
    ++number;
    for (const auto &mu : entry.solution.multipliers)
    {
      csv += std::to_string(number);
      for (const double x : {mu.real(), mu.imag(), std::abs(mu)})
        append_exact(csv += ',', x);
      csv += '\n';
    }
  }
  return csv;
}

std::string special_points_csv(const PeriodicResult &result)
{
  std::string csv = "kind," + parameter_head(result) + ",period [s],solution\n";
  for (const SpecialPoint &point : result.special_points)
  {
    csv += point.kind;
    append_parameter(result, point.parameter, csv);
    append_exact(csv += ',', point.period);
    csv += ',' + std::to_string(point.solution) + '\n';
  }
  return csv;
}

std::vector<std::pair<std::string, std::string>> orbit_files(const PeriodicResult &result)
{
  std::vector<std::pair<std::string, std::string>> files;
  int                                              number = 0;
  for (const PeriodicEntry &entry : result.entries)
  {
    ++number;
    const std::size_t width = entry.signals.size() + 1;
    std::string       csv   = "t [s]";
    for (const SignalOrbit &signal : entry.signals)
      csv += ',' + csv_field(signal.name + " [" + signal.unit + "]");
    csv += '\n';
    for (std::size_t i = 0; i < entry.rows.size(); ++i)
    {
      append_exact(csv, entry.rows[i]);
      csv += (i + 1) % width == 0 ? '\n' : ',';
    }
    files.emplace_back("orbit_" + std::to_string(number) + ".csv", csv);
  }
  return files;
}

} // namespace gestell::apps

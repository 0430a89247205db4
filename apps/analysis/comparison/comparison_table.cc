#include "apps/analysis/comparison/comparison_table.h"

#include "apps/output/text/csv.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::apps
{

namespace
{

/// The pair of a mode, or null.
const coupling::ModePair *pair_of(const ComparedShapes &shapes, int coupling::ModePair::*side, std::size_t mode)
{
  const auto &pairs = shapes.match.pairs;
  const auto  found =
      std::find_if(pairs.begin(), pairs.end(), [&](const auto &pair) { return pair.*side == int(mode); });
  return found == pairs.end() ? nullptr : &*found;
}

std::string half_row(const ComparedModes &side, std::size_t mode)
{
  return std::to_string(mode + 1) + ',' + exact_text(side.modes[mode].frequency_hz);
}

std::string row_of(const ComparedShapes &shapes, std::size_t i)
{
  const coupling::ModePair *pair = pair_of(shapes, &coupling::ModePair::a, i);
  const std::string         head = half_row(shapes.a, i) + ',', seen = exact_text(shapes.match.seen_a[Eigen::Index(i)]);
  if (!pair)
    return head + ",,,," + seen + ",\n";
  return head + half_row(shapes.b, std::size_t(pair->b)) + ',' + exact_text(frequency_ratio(shapes, *pair)) + ',' +
         exact_text(pair->assurance) + ',' + seen + ',' + exact_text(shapes.match.seen_b[pair->b]) + '\n';
}

const coupling::SignalSummary &signal_named(const coupling::RunResult &run, const std::string &name)
{
  return *std::find_if(run.signals.begin(), run.signals.end(), [&](const auto &signal) { return signal.name == name; });
}

} // namespace

std::string compared_run_csv(const coupling::RunResult &run, const ComparedRun &other)
{
  std::string csv = "signal,unit,extreme,value,t [s],other value,other t [s],ratio\n";
  for (const auto &[name, signal] : other.signals)
    for (const auto &[which, own] : {std::pair("max", signal.max), {"min", signal.min}})
    {
      csv += csv_field(name) + ',' + signal_named(run, name).unit + ',' + which;
      for (const double x : {own.value, own.t, own.other, own.other_t, own.ratio()})
        append_exact(csv += ',', x);
      csv += '\n';
    }
  return csv;
}

double frequency_ratio(const ComparedShapes &shapes, const coupling::ModePair &pair)
{
  const double a = shapes.a.modes[std::size_t(pair.a)].frequency_hz;
  return a > 0. ? shapes.b.modes[std::size_t(pair.b)].frequency_hz / a : std::numeric_limits<double>::quiet_NaN();
}

std::string compared_modes_csv(const ComparedShapes &shapes)
{
  std::string csv = "mode,frequency [Hz],other mode,other frequency [Hz],ratio,MAC,seen,other seen\n";
  for (std::size_t i = 0; i < shapes.a.modes.size(); ++i)
    csv += row_of(shapes, i);
  for (std::size_t j = 0; j < shapes.b.modes.size(); ++j)
    if (!pair_of(shapes, &coupling::ModePair::b, j))
      csv += ",," + half_row(shapes.b, j) + ",,,," + exact_text(shapes.match.seen_b[Eigen::Index(j)]) + '\n';
  return csv;
}

std::string mac_csv(const ComparedShapes &shapes)
{
  std::string csv = "mode";
  for (std::size_t j = 0; j < shapes.b.modes.size(); ++j)
    csv += ",other " + std::to_string(j + 1);
  csv += '\n';
  for (Eigen::Index i = 0; i < shapes.match.mac.rows(); ++i)
  {
    csv += std::to_string(i + 1);
    for (Eigen::Index j = 0; j < shapes.match.mac.cols(); ++j)
      append_exact(csv += ',', shapes.match.mac(i, j));
    csv += '\n';
  }
  return csv;
}

} // namespace gestell::apps

#include "apps/output/tables/comparison_table.h"

#include "apps/output/tables/noise.h"
#include "apps/output/text/csv.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

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

/// An extreme of a signal in both runs.
struct ComparedExtreme
{
  const char *which;
  double      value, t, other, other_t;

  double ratio() const { return value != 0. ? other / value : std::numeric_limits<double>::quiet_NaN(); }
};

std::array<ComparedExtreme, 2> extremes_of(const coupling::SignalSummary &a, const coupling::SignalSummary &b)
{
  return {{{"max", a.max, a.t_max, b.max, b.t_max}, {"min", a.min, a.t_min, b.min, b.t_min}}};
}

} // namespace

std::string compared_run_csv(const coupling::RunResult &run, const ComparedRun &other)
{
  std::string csv = "signal,unit,extreme,value,t [s],other value,other t [s],ratio\n";
  for (const SharedSignal shared : shared_signals(run, other.run))
    for (const ComparedExtreme &own : extremes_of(run.signals[shared.a], other.run.signals[shared.b]))
    {
      csv += csv_field(run.signals[shared.a].name) + ',' + run.signals[shared.a].unit + ',' + own.which;
      for (const double x : {own.value, own.t, own.other, own.other_t, own.ratio()})
        append_exact(csv += ',', x);
      csv += '\n';
    }
  return csv;
}

std::string compared_run_text(const coupling::RunResult &run, const ComparedRun &other)
{
  std::ostringstream text;
  text << "beside " << other.scene << ": " << std::left << "\n  " << std::setw(12) << "signal" << std::right
       << std::setw(5) << "" << std::setw(16) << "here" << std::setw(16) << "there" << std::setw(10) << "ratio" << '\n';
  const Noise noise = noise_of(run.signals);
  const auto  shown = [&](const std::string &unit, double x) { return short_text(noise.without(unit, x), 6); };
  for (const SharedSignal shared : shared_signals(run, other.run))
    for (const ComparedExtreme &own : extremes_of(run.signals[shared.a], other.run.signals[shared.b]))
      text << "  " << std::left << std::setw(12) << run.signals[shared.a].name << std::setw(5) << own.which
           << std::right << std::setw(16) << shown(run.signals[shared.a].unit, own.value) << std::setw(16)
           << shown(run.signals[shared.a].unit, own.other) << std::setw(10) << short_text(own.ratio()) << "  "
           << run.signals[shared.a].unit << '\n';
  return text.str();
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

std::string compared_modes_text(const ComparedShapes &shapes)
{
  std::ostringstream text;
  text << "modes of " << shapes.a.scene << " beside those of " << shapes.b.scene << ", matched by "
       << count_text(shapes.measures.size(), "shared measure") << "\n"
       << "  mode   frequency [Hz]   other   frequency [Hz]    ratio      MAC   seen   of the other\n";
  for (const coupling::ModePair &pair : shapes.match.pairs)
    text << std::setw(6) << pair.a + 1 << std::setw(17)
         << short_text(shapes.a.modes[std::size_t(pair.a)].frequency_hz, 6) << std::setw(8) << pair.b + 1
         << std::setw(17) << short_text(shapes.b.modes[std::size_t(pair.b)].frequency_hz, 6) << std::setw(9)
         << short_text(frequency_ratio(shapes, pair)) << std::setw(9) << short_text(pair.assurance, 3) << std::setw(7)
         << short_text(shapes.match.seen_a[pair.a], 2) << std::setw(15) << short_text(shapes.match.seen_b[pair.b], 2)
         << '\n';
  const std::size_t pairs = shapes.match.pairs.size();
  text << "  without a partner: " << shapes.a.modes.size() - pairs << " of the first, " << shapes.b.modes.size() - pairs
       << " of the other\n";
  return text.str();
}

} // namespace gestell::apps

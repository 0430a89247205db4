#include "apps/analysis/comparison/comparison_table.h"

#include <algorithm>
#include <array>
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

const coupling::SignalSummary &signal_named(const coupling::RunResult &run, const std::string &name)
{
  return *std::find_if(run.signals.begin(), run.signals.end(), [&](const auto &signal) { return signal.name == name; });
}

} // namespace

CsvTable compared_run_csv(const coupling::RunResult &run, const ComparedRun &other)
{
  CsvTable csv({"signal", "unit", "extreme", "value", "t [s]", "other value", "other t [s]", "ratio"});
  for (const auto &[name, signal] : other.signals)
    for (const auto &[which, own] : {std::pair("max", signal.max), {"min", signal.min}})
      csv.add(name, signal_named(run, name).unit, which, own.value, own.t, own.other, own.other_t, own.ratio());
  return csv;
}

double frequency_ratio(const ComparedShapes &shapes, const coupling::ModePair &pair)
{
  const double a = shapes.a.modes[std::size_t(pair.a)].frequency_hz;
  return a > 0. ? shapes.b.modes[std::size_t(pair.b)].frequency_hz / a : std::numeric_limits<double>::quiet_NaN();
}

CsvTable compared_modes_csv(const ComparedShapes &shapes)
{
  CsvTable csv({"mode", "frequency [Hz]", "other mode", "other frequency [Hz]", "ratio", "MAC", "seen", "other seen"});
  const auto half = [](const ComparedModes &side, std::size_t mode) {
    return std::array{double(mode + 1), side.modes[mode].frequency_hz};
  };
  for (std::size_t i = 0; i < shapes.a.modes.size(); ++i)
  {
    const coupling::ModePair *pair = pair_of(shapes, &coupling::ModePair::a, i);
    const double              seen = shapes.match.seen_a[Eigen::Index(i)];
    if (pair)
      csv.add(half(shapes.a, i), half(shapes.b, std::size_t(pair->b)), frequency_ratio(shapes, *pair), pair->assurance,
              seen, shapes.match.seen_b[pair->b]);
    else
      csv.add(half(shapes.a, i), "", "", "", "", seen, "");
  }
  for (std::size_t j = 0; j < shapes.b.modes.size(); ++j)
    if (!pair_of(shapes, &coupling::ModePair::b, j))
      csv.add("", "", half(shapes.b, j), "", "", "", shapes.match.seen_b[Eigen::Index(j)]);
  return csv;
}

CsvTable mac_csv(const ComparedShapes &shapes)
{
  std::vector<std::string> heads{"mode"};
  for (std::size_t j = 0; j < shapes.b.modes.size(); ++j)
    heads.push_back("other " + std::to_string(j + 1));
  CsvTable csv(heads);
  for (Eigen::Index i = 0; i < shapes.match.mac.rows(); ++i)
    csv.add(i + 1, Eigen::VectorXd(shapes.match.mac.row(i)));
  return csv;
}

} // namespace gestell::apps

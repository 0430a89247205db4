#include "apps/output/charts/signal_charts.h"

#include "apps/output/charts/chart.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <tuple>

namespace gestell::apps
{
namespace
{

struct SignalRange
{
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  double span() const { return high >= low ? high - low : 0.; }
  double size() const { return high >= low ? std::max(std::abs(low), std::abs(high)) : 0.; }
};

/// The history by columns, each with its range.
struct SignalColumns
{
  explicit SignalColumns(const coupling::RunResult &run)
      : values(run.columns.size(), std::vector<double>(run.columns.empty() ? 0 : run.rows.size() / run.columns.size())),
        ranges(values.size())
  {
    for (std::size_t i = 0, k = 0; !values.empty() && i < values.front().size(); ++i)
      for (std::size_t j = 0; j < values.size(); ++j, ++k)
        values[j][i] = run.rows[k];
    for (std::size_t j = 0; j < values.size(); ++j)
      for (const double y : values[j])
        if (std::isfinite(y))
          ranges[j] = {std::min(ranges[j].low, y), std::max(ranges[j].high, y)};
  }

  std::vector<std::vector<double>> values;
  std::vector<SignalRange>         ranges;
};

ChartTopic topic_of(const std::string &unit)
{
  if (unit == "N" || unit == "N m")
    return ChartTopic::force;
  if (unit == "J")
    return ChartTopic::energy;
  const std::string base = unit.substr(0, unit.find('/'));
  return base == "m" || base == "rad" ? ChartTopic::motion : ChartTopic::other;
}

std::string quantity_of(const std::string &unit)
{
  static const std::map<std::string, std::string> names = {{"N", "Forces"},
                                                           {"N m", "Moments"},
                                                           {"m", "Displacements"},
                                                           {"m/s", "Velocities"},
                                                           {"m/s^2", "Accelerations"},
                                                           {"rad", "Angles"},
                                                           {"rad/s", "Angular speeds"},
                                                           {"J", "Energy"},
                                                           {"W", "Power"}};
  const auto                                      name  = names.find(unit);
  return name != names.end() ? name->second : "Signals";
}

std::string joined_names(const coupling::RunResult &run, const SignalGroup &group)
{
  std::string names;
  for (const std::size_t j : group.columns)
    names += (names.empty() ? "" : ", ") + run.columns[j];
  return names;
}

/// The names are also in the legend; the title contains as many as fit.
std::string names_in_title(const coupling::RunResult &run, const SignalGroup &group)
{
  constexpr std::size_t most_letters = 80; // of a title: 8 pixels each over 640
  const std::string     names        = joined_names(run, group);
  return n_letters(names) <= most_letters ? ": " + names : ", " + std::to_string(group.columns.size()) + " signals";
}

Chart chart_of(const coupling::RunResult &run, const SignalColumns &columns, const SignalGroup &group)
{
  double size = 0.;
  for (const std::size_t j : group.columns)
    size = std::max(size, columns.ranges[j].size());
  const DisplayUnit shown = display_unit(group.unit, size);

  Chart chart;
  chart.width  = 880.;
  chart.height = 290.;
  chart.title  = quantity_of(group.unit);
  if (topic_of(group.unit) != ChartTopic::energy)
    chart.title += names_in_title(run, group);
  chart.x.label = "t [s]";
  chart.y.label = "[" + shown.unit + "]";
  for (const std::size_t j : group.columns)
  {
    Curve curve{run.columns[j], columns.values.front(), columns.values[j]};
    for (double &y : curve.y)
      y *= shown.factor;
    chart.panels[0].add(std::move(curve));
  }
  int number = 0;
  for (const coupling::Event &event : run.events)
    chart.marks.push_back({event.t, short_text(event.t, 6) + " s  " + event.name + ": " + event.kind, ++number});
  return chart;
}

/// Name for files from the title of a quantity: small letters, dashes for blanks.
std::string file_name(std::string text)
{
  for (char &c : text)
    c = c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Where a signal changes most within the duration of a shock, and by how much.
std::pair<double, double> hardest_change(const SignalColumns &columns, std::size_t j)
{
  const std::vector<double> &t = columns.values.front(), &y = columns.values[j];
  // A shock lasts no longer than this part of the run; what is slower is a vibration.
  constexpr std::size_t shock_share = 200;
  const std::size_t     reach       = std::max<std::size_t>(1, y.size() / shock_share);
  double                at = t.front(), change = 0.;
  for (std::size_t i = 0; i + reach < y.size(); ++i)
    if (std::abs(y[i + reach] - y[i]) > change)
    {
      change = std::abs(y[i + reach] - y[i]);
      at     = t[i];
    }
  return {at, change};
}

/// Whether the shock shows in one of the signals: a third of its way within the time of a shock.
bool is_shaken(const SignalColumns &columns, const SignalGroup &group)
{
  return std::any_of(group.columns.begin(), group.columns.end(),
                     [&](std::size_t j) { return hardest_change(columns, j).second > columns.ranges[j].span() / 3.; });
}

std::vector<SignalGroup> groups_of(const coupling::RunResult &run, const SignalColumns &columns)
{
  std::vector<std::string>                        units; // in the order of their first column
  std::map<std::string, std::vector<std::size_t>> of_unit;
  for (std::size_t j = 1; j < run.columns.size(); ++j)
  {
    if (of_unit.count(run.units[j]) == 0)
      units.push_back(run.units[j]);
    of_unit[run.units[j]].push_back(j);
  }

  std::vector<SignalGroup> groups;
  for (const std::string &unit : units)
  {
    std::vector<std::pair<double, std::size_t>> by_span;
    for (const std::size_t j : of_unit[unit])
      by_span.emplace_back(columns.ranges[j].span(), j);
    std::stable_sort(by_span.begin(), by_span.end(), [](auto &a, auto &b) { return a.first > b.first; });

    double widest = -1.;
    for (const auto &[span, j] : by_span)
    {
      constexpr double readable_ratio = 15.; // of the widest span, 280 pixels high: narrower curves look like lines
      if (widest < 0. || span * readable_ratio < widest || int(groups.back().columns.size()) == n_series_colours)
      {
        groups.push_back({unit, {}});
        widest = span;
      }
      groups.back().columns.push_back(j);
    }
  }
  for (SignalGroup &group : groups)
    std::sort(group.columns.begin(), group.columns.end());
  return groups;
}

std::pair<double, double> shock_of(const coupling::RunResult &run, const SignalColumns &columns)
{
  const std::size_t     width = run.columns.size(), n = width > 0 ? run.rows.size() / width : 0;
  constexpr std::size_t fewest_for_zoom = 200; // rows: a shock lasts a 200th of them, one row at least
  if (n < fewest_for_zoom || width < 2)
    return {0., 0.};

  double widest = 0.;
  for (std::size_t j = 1; j < width; ++j)
    if (run.units[j] == "N")
      widest = std::max(widest, columns.ranges[j].span());
  double at      = hardest_change(columns, 1).first,
         hardest = 0.; // share of its range by which a force of some size changes: rings follow
  for (std::size_t j = 1; j < width; ++j)
    if (const double span = columns.ranges[j].span(); run.units[j] == "N" && span > 0. && span >= widest / 3.)
      if (const auto [t, change] = hardest_change(columns, j); change / span > hardest)
      {
        hardest = change / span;
        at      = t;
      }
  const double first = run.rows.front(), last = run.rows[(n - 1) * width], zoom = (last - first) / 8.;
  const double begin = std::clamp(at - 0.25 * zoom, first, last - zoom);
  return {begin, begin + zoom};
}

} // namespace

std::vector<SignalGroup> group_signals(const coupling::RunResult &run)
{
  return groups_of(run, SignalColumns(run));
}

std::pair<double, double> main_shock(const coupling::RunResult &run)
{
  return shock_of(run, SignalColumns(run));
}

std::vector<SignalChart> signal_charts(const coupling::RunResult &run)
{
  std::vector<SignalChart> charts;
  if (run.columns.size() < 2 || run.rows.size() < 2 * run.columns.size())
    return charts;

  const SignalColumns        columns(run);
  const auto                 shock = shock_of(run, columns);
  std::map<std::string, int> used; // how often a quantity has had a chart
  for (const SignalGroup &group : groups_of(run, columns))
  {
    Chart       chart = chart_of(run, columns, group);
    std::string name  = file_name(quantity_of(group.unit));
    if (const int n = ++used[name]; n > 1)
      name += "-" + std::to_string(n);
    const auto add = [&](const std::string &as, Chart shown, bool is_part)
    {
      std::string svg = chart_svg(shown);
      charts.push_back({as, std::move(svg), topic_of(group.unit), std::move(shown), is_part});
    };
    if (topic_of(group.unit) == ChartTopic::force && shock.second > shock.first && is_shaken(columns, group))
    {
      add(name, chart, false);
      chart.title += ", around the main shock";
      std::tie(chart.x.begin, chart.x.end) = shock;
      name += "-shock";
    }
    const bool is_part = !std::isnan(chart.x.begin);
    add(name, std::move(chart), is_part);
  }
  return charts;
}

} // namespace gestell::apps

#include "apps/analysis/periodic/periodic_charts.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace gestell::apps
{
namespace
{

void square_plane(Chart &chart)
{
  chart.width  = 372.;
  chart.height = 320.;
}

std::string with_unit(const std::string &name, const std::string &unit)
{
  return unit.empty() ? name : name + " [" + unit + "]";
}

/// The axis with a margin around the values; its span is at least a thousandth of the largest value.
ChartAxis axis_about(const std::string &label, double low, double high)
{
  // span of values, of their size: rounding of a constant value fills no chart
  constexpr double all_but_one = 1e-3;
  const double     least       = all_but_one * std::max(std::abs(low), std::abs(high));
  const double     more        = 0.5 * std::max(0., least - (high - low));
  ChartAxis        axis;
  axis.label = label;
  return fitted(axis, low - more, high + more, 0.05);
}

Chart plane_of(const PhasePlane &plane)
{
  Chart chart;
  square_plane(chart);
  double low[2]  = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  double high[2] = {-low[0], -low[1]};
  for (const PhasePlane::Curve &curve : plane.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      for (const int k : {0, 1})
      {
        low[k]  = std::min(low[k], k == 0 ? curve.x[i] : curve.rate[i]);
        high[k] = std::max(high[k], k == 0 ? curve.x[i] : curve.rate[i]);
      }
  chart.x = axis_about(with_unit(plane.name, plane.unit), low[0], high[0]);
  chart.y = axis_about(with_unit(plane.name + "'", plane.unit.empty() ? "" : plane.unit + "/s"), low[1], high[1]);
  return chart;
}

/// Amplitudes over the largest one; empty: the signal does not move.
std::vector<double> shares_of(const SignalOrbit &signal)
{
  const double largest =
      signal.amplitude.empty() ? 0. : *std::max_element(signal.amplitude.begin(), signal.amplitude.end());
  std::vector<double> shares;
  for (const double amplitude : signal.amplitude)
    if (largest > 0.)
      shares.push_back(amplitude / largest);
  return shares;
}

double apart(const std::vector<double> &a, const std::vector<double> &b)
{
  double sum = 0.;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    sum += std::abs(a[k] - b[k]);
  return sum;
}

/// Starts with the signal of the richest spectrum, then adds those most different from all selected ones.
std::vector<std::size_t> most_different(const std::vector<SignalOrbit> &signals)
{
  std::vector<std::vector<double>> shares;
  std::vector<std::size_t>         left, taken;
  for (const SignalOrbit &signal : signals)
  {
    shares.push_back(shares_of(signal));
    if (!shares.back().empty())
      left.push_back(shares.size() - 1);
  }
  constexpr std::size_t most_barred = 4; // signals whose bars of one harmonic can be distinguished
  const auto            distance    = [&](std::size_t i)
  {
    if (taken.empty())
      return std::accumulate(shares[i].begin(), shares[i].end(), 0.);
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t other : taken)
      least = std::min(least, apart(shares[i], shares[other]));
    return least;
  };
  while (!left.empty() && taken.size() < most_barred)
  {
    const auto best = std::max_element(left.begin(), left.end(),
                                       [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    taken.push_back(*best);
    left.erase(best);
  }
  std::sort(taken.begin(), taken.end());
  return taken;
}

/// A value of the solutions over the parameter, for stable or unstable ones; branches are not connected.
Curve branch_curve(const PeriodicResult &result, bool stable, const std::function<double(const PeriodicEntry &)> &value)
{
  Curve curve;
  curve.colour                = stable ? 0 : 3;
  curve.line                  = stable ? LineStyle::full : LineStyle::dashed;
  const PeriodicEntry *before = nullptr;
  for (const PeriodicEntry &entry : result.entries)
  {
    const bool       goes_on = before && before->branch == entry.branch;
    const bool       here = entry.solution.stable() == stable, was = goes_on && before->solution.stable() == stable;
    constexpr double nan_here = std::numeric_limits<double>::quiet_NaN();
    if (!here && !was)
      curve.add(entry.parameter, nan_here);
    else
    {
      if (!goes_on)
        curve.add(entry.parameter, nan_here);
      else if (here && !was)
        curve.add(before->parameter, value(*before));
      if (here)
        curve.add(entry.parameter, value(entry));
    }
    before = &entry;
  }
  return curve;
}

void add_if_seen(Panel &panel, const Curve &curve)
{
  if (std::any_of(curve.y.begin(), curve.y.end(), [](double y) { return !std::isnan(y); }))
    panel.curves.push_back(curve);
}

void add_special_points(const PeriodicResult &result, const std::function<double(const PeriodicEntry &)> &value,
                        Panel &panel)
{
  Curve special = rings("", 5);
  for (const SpecialPoint &point : result.special_points)
  {
    special.add(point.parameter, value(result.entries[std::size_t(point.solution) - 1]));
    special.notes.push_back({point.kind + " at " + short_text(point.parameter, 8)});
  }
  add_if_seen(panel, special);
}

Chart over_parameter(const PeriodicResult &result, const SignalOrbit &signal)
{
  Chart chart;
  chart.width   = 880.;
  chart.height  = 300.;
  chart.x.label = with_unit(result.parameter, result.parameter_unit);
  chart.y.label = with_unit(signal.name, signal.unit);
  return chart;
}

} // namespace

Chart multiplier_chart(const std::vector<PeriodicEntry> &entries, std::size_t most_solutions)
{
  Chart chart;
  square_plane(chart);
  chart.title   = "Floquet multipliers";
  chart.note    = "inside the circle disturbances decay";
  chart.x.label = "real part";
  chart.y.label = "imaginary part";
  Curve circle;
  circle.colour               = 6;
  constexpr int circle_points = 180; // a chord is 2e-4 of the radius off its arc, less than a pixel
  for (int k = 0; k <= circle_points; ++k)
    circle.add(std::cos(2. * M_PI * k / circle_points), std::sin(2. * M_PI * k / circle_points));
  chart.panels[0].curves.push_back(circle);
  double reach  = 1.1;
  Curve  inside = rings("stable", 0), outside = rings("unstable", 3);
  for (std::size_t i = 0; i < std::min(entries.size(), most_solutions); ++i)
  {
    const coupling::PeriodicSolution &solution = entries[i].solution;
    for (const auto &mu : solution.multipliers)
    {
      (solution.stable() ? inside : outside).add(mu.real(), mu.imag());
      reach = std::max(reach, 1.1 * std::abs(mu));
    }
  }
  for (const Curve &curve : {inside, outside})
    if (!curve.x.empty())
      chart.panels[0].curves.push_back(curve);
  chart.x.begin = chart.y.begin = -reach;
  chart.x.end = chart.y.end = reach;
  return chart;
}

Chart harmonics_chart(const PeriodicEntry &entry, std::size_t number)
{
  const std::vector<std::size_t> barred = most_different(entry.signals);
  Chart                          chart;
  chart.title                       = "Harmonics of solution " + std::to_string(number);
  chart.note                        = "amplitudes relative to the largest one of each signal";
  chart.width                       = 480.;
  chart.height                      = 320.;
  chart.x.label                     = "multiple of the excitation frequency";
  chart.y.label                     = "relative amplitude";
  chart.x.begin                     = 0.5;
  chart.y.begin                     = 0.;
  chart.y.end                       = 1.05;
  std::size_t      n_harmonics      = 1;
  constexpr double bars_of_harmonic = 0.8; // width of all bars of a harmonic
  const double     width            = bars_of_harmonic / double(std::max<std::size_t>(barred.size(), 1));
  for (std::size_t j = 0; j < barred.size(); ++j)
  {
    const SignalOrbit        &signal = entry.signals[barred[j]];
    const std::vector<double> shares = shares_of(signal);
    n_harmonics                      = std::max(n_harmonics, shares.size());
    chart.panels[0].curves.push_back(tile_name(signal.name, int(j)));
    for (std::size_t k = 0; k < shares.size(); ++k)
    {
      const double x = double(k + 1) - 0.5 * bars_of_harmonic + double(j) * width;
      chart.panels[0].tiles.push_back(
          {x, x + 0.9 * width, 0., shares[k], int(j),
           signal.name + ", " + std::to_string(k + 1) + ": " + short_text(signal.amplitude[k], 5) + " " + signal.unit});
    }
  }
  chart.x.end = double(n_harmonics) + 0.5;
  for (std::size_t k = 1; k <= n_harmonics; ++k)
    chart.x.ticks.push_back(double(k));
  return chart;
}

std::string not_barred(const PeriodicEntry &entry)
{
  const std::vector<std::size_t> barred = most_different(entry.signals);
  std::string                    names;
  for (std::size_t i = 0; i < entry.signals.size(); ++i)
    if (!std::binary_search(barred.begin(), barred.end(), i))
      names += (names.empty() ? "" : ", ") + entry.signals[i].name;
  return names.empty() ? "" : "Not drawn: " + names + ".";
}

Chart phase_plane_chart(const PhasePlane &plane)
{
  Chart chart = plane_of(plane);
  chart.title = plane.name + ", phase plane";
  chart.note  = "dashed: unstable; discs: start of a period";
  for (const PhasePlane::Curve &motion : plane.curves)
  {
    Curve curve;
    curve.name   = "no. " + std::to_string(motion.solution);
    curve.colour = motion.solution - 1;
    curve.line   = motion.stable ? LineStyle::full : LineStyle::dashed;
    curve.x      = motion.x;
    curve.y      = motion.rate;
    chart.panels[0].curves.push_back(curve);
    Curve begins{"", {}, {}, curve.colour, LineStyle::none, Marker::disc};
    for (const std::size_t i : motion.begins)
      begins.add(motion.x[i], motion.rate[i]);
    chart.panels[0].curves.push_back(begins);
  }
  return chart;
}

Chart section_chart(const PhasePlane &plane, int periods)
{
  Chart chart = plane_of(plane);
  chart.title = plane.name + ", Poincaré section";
  chart.note  = "at the start of " + std::to_string(periods) + " periods of the excitation";
  for (const PhasePlane::Curve &motion : plane.curves)
    chart.panels[0].curves.push_back({"", motion.x, motion.rate, 0, LineStyle::none, Marker::disc});
  return chart;
}

Chart basins_chart(const BasinMap &map)
{
  const coupling::Basins     &basins = map.basins;
  const coupling::StartPlane &plane  = basins.plane;
  Chart                       chart;
  chart.title = "Basins of attraction of the stable solutions";
  chart.note  = basins.share(coupling::Basins::not_reached) > 0. ? "white: no stable solution; discs: start of a period"
                                                                 : "discs: start of a period";
  chart.width = 640.;
  chart.height        = 520.;
  chart.x.label       = map.x_name;
  chart.y.label       = map.y_name;
  chart.x.begin       = plane.x_begin;
  chart.x.end         = plane.x_end;
  chart.y.begin       = plane.y_begin;
  chart.y.end         = plane.y_end;
  const double width  = (plane.x_end - plane.x_begin) / plane.points,
               height = (plane.y_end - plane.y_begin) / plane.points;
  for (int j = 0; j < plane.points; ++j)
    for (int i = 0, end = 0; i < plane.points; i = end)
    {
      const int motion = basins.motion(i, j);
      for (end = i + 1; end < plane.points && basins.motion(end, j) == motion; ++end)
      {
      }
      constexpr double cell_overlap = 0.05; // share of a cell under the next one: no gaps
      if (motion > 0)
        chart.panels[0].tiles.push_back({plane.x_begin + i * width, plane.x_begin + (end + cell_overlap) * width,
                                         plane.y_begin + j * height, plane.y_begin + (j + 1 + cell_overlap) * height,
                                         motion - 1});
    }
  for (int motion = 1; motion <= basins.motion.maxCoeff(); ++motion)
    if (const double share = basins.share(motion); share > 0.)
      chart.panels[0].curves.push_back(
          tile_name("no. " + std::to_string(motion) + ", " + short_text(100. * share, 3) + " %", motion - 1));
  Curve begins{"", {}, {}, 5, LineStyle::none, Marker::disc};
  for (const coupling::Basins::Place &place : basins.places)
  {
    begins.add(place.x, place.y);
    begins.notes.push_back({"no. " + std::to_string(place.motion), true});
  }
  chart.panels[0].curves.push_back(begins);
  return chart;
}

Chart response_chart(const PeriodicResult &result, std::size_t signal)
{
  const SignalOrbit &of    = result.entries.front().signals[signal];
  Chart              chart = over_parameter(result, of);
  chart.title              = of.name + " of the periodic solutions";
  chart.note               = "largest and smallest value; dashed: unstable; rings: special points";
  for (const bool largest : {true, false})
    for (const bool stable : {true, false})
    {
      Curve curve = branch_curve(result, stable,
                                 [&](const PeriodicEntry &at)
                                 { return largest ? at.signals[signal].max : at.signals[signal].min; });
      curve.name  = !largest ? "" : stable ? "stable" : "unstable";
      add_if_seen(chart.panels[0], curve);
    }
  add_special_points(
      result, [&](const PeriodicEntry &at) { return at.signals[signal].max; }, chart.panels[0]);
  return chart;
}

Chart amplitude_chart(const PeriodicResult &result, std::size_t signal)
{
  const auto         a1    = [&](const PeriodicEntry &at) { return at.signals[signal].amplitude.at(0); };
  const SignalOrbit &of    = result.entries.front().signals[signal];
  Chart              chart = over_parameter(result, of);
  chart.title              = of.name + ", first harmonic of the excitation";
  chart.note               = "amplitude; dashed: unstable; rings: special points" +
               std::string(result.backbone.empty() ? "" : "; dotted: free vibration by describing functions");
  for (const bool stable : {true, false})
  {
    Curve curve = branch_curve(result, stable, a1);
    curve.name  = stable ? "stable" : "unstable";
    add_if_seen(chart.panels[0], curve);
  }
  Curve backbone;
  backbone.name   = "backbone";
  backbone.colour = 6;
  backbone.line   = LineStyle::dotted;
  for (const PeriodicEntry &entry : result.backbone)
    backbone.add(entry.parameter, a1(entry));
  add_if_seen(chart.panels[0], backbone);
  add_special_points(result, a1, chart.panels[0]);
  return chart;
}

} // namespace gestell::apps

#include "apps/output/charts/stability_maps.h"

#include "apps/output/charts/chart.h"
#include "coupling/integration/propagation/force_rule.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

using coupling::ForceRule;
using coupling::options_of;
using coupling::Spring;

/// omega h of the maps: from steps that are all but exact to ones without end
constexpr double lowest = 1e-2, highest = 1e3;

MappedMethod bdf(int order)
{
  return {options_of("bdf", order), Spring::base, "BDF " + std::to_string(order)};
}

MappedMethod newmark(double beta, double gamma, const std::string &name)
{
  return {options_of("newmark").with("beta", beta).with("gamma", gamma), Spring::base, name};
}

MappedMethod wilson(double theta)
{
  return {options_of("wilson").with("theta", theta), Spring::base, "Wilson " + short_text(theta)};
}

MappedMethod hht(double alpha)
{
  return {options_of("hht").with("alpha", alpha), Spring::base, "HHT " + short_text(alpha)};
}

MappedMethod generalised_alpha(double rho_inf)
{
  return {options_of("generalised-alpha").with("rho_inf", rho_inf), Spring::base,
          "generalised alpha " + short_text(rho_inf)};
}

MappedMethod central_difference()
{
  return {options_of("central-difference"), Spring::base, "central differences"};
}

MappedMethod exact(ForceRule force, int order, const std::string &name)
{
  return {options_of("exact", order).with("force", force_rule_name(force)), Spring::contact, name};
}

const StabilityMap *map_of(const std::vector<StabilityMap> &maps, const std::string &method, double zeta)
{
  for (const StabilityMap &map : maps)
    if (map.method == method && map.zeta == zeta)
      return &map;
  return nullptr;
}

std::vector<Mark> marks_of(const std::vector<coupling::ModeAccuracy> &modes)
{
  std::vector<Mark> marks;
  for (const auto &mode : modes)
  {
    const bool closed = mode.origin == coupling::ModeOrigin::closed;
    marks.push_back({mode.omega_h,
                     std::string(closed ? "closed contacts" : "frame") + ", mode " + std::to_string(mode.number) +
                         ": " + short_text(mode.mode.omega / 6.283185307179586) + " Hz",
                     0, closed ? 1 : 0});
  }
  return marks;
}

/// The positive part of a curve, and the mirrored negative part.
void add_signed(Panel &panel, const StabilityMap &map, const std::vector<double> &y, int colour)
{
  Curve above{map.method, map.omega_h, y, colour}, below{"", map.omega_h, y, colour, LineStyle::dashed};
  for (double &value : below.y)
    value = -value;
  panel.curves.push_back(above);
  if (std::any_of(below.y.begin(), below.y.end(), [](double value) { return value > 1e-16; }))
    panel.curves.push_back(below);
}

} // namespace

std::vector<MethodFamily> method_families()
{
  return {{"BDF", {bdf(1), bdf(2), bdf(3), bdf(4), bdf(5), bdf(6)}},
          {"Newmark, central differences, Wilson",
           {newmark(0.25, 0.5, "average acceleration"), newmark(1. / 6., 0.5, "linear acceleration"),
            newmark(0.3025, 0.6, "Newmark 0.3025 0.6"), central_difference(), wilson(1.3), wilson(1.4)}},
          {"HHT and generalised alpha",
           {hht(-0.05), hht(-0.3), generalised_alpha(0.9), generalised_alpha(0.8), generalised_alpha(0.5),
            generalised_alpha(0.)}},
          {"Exact propagation, closed contact",
           {exact(ForceRule::average, 2, "average force"), exact(ForceRule::linear, 2, "linear force"),
            exact(ForceRule::collocation, 2, "collocation 2"), exact(ForceRule::collocation, 4, "collocation 4"),
            exact(ForceRule::collocation, 6, "collocation 6"), exact(ForceRule::collocation, 8, "collocation 8")}}};
}

std::vector<StabilityMap> stability_maps(const std::vector<MethodFamily> &families, const std::vector<double> &zetas)
{
  constexpr int             points_per_decade = 100; // five decades, a point for each pixel or two
  const int                 n = static_cast<int>(std::lround(points_per_decade * std::log10(highest / lowest)));
  std::vector<StabilityMap> maps;
  for (const double zeta : zetas)
    for (std::size_t family = 0; family < families.size(); ++family)
      for (const MappedMethod &method : families[family].methods)
      {
        StabilityMap map{method.name, static_cast<int>(family), zeta, {}, {}, {}};
        for (int i = 0; i <= n; ++i)
        {
          const coupling::TestOscillator o{zeta, lowest * std::pow(highest / lowest, double(i) / n), method.spring};
          map.omega_h.push_back(o.omega_h);
          map.step.push_back(coupling::step_properties(method.options, o));
          map.displaced.push_back(coupling::overshoot(method.options, o, coupling::OscillatorStart::displaced));
        }
        maps.push_back(std::move(map));
      }
  return maps;
}

std::vector<MappedInterval> unstable_maps(const std::vector<MethodFamily> &families, const std::vector<double> &zetas)
{
  std::vector<MappedInterval> intervals;
  for (const MethodFamily &family : families)
    for (const MappedMethod &method : family.methods)
      for (const double zeta : zetas)
        for (const auto &interval : coupling::unstable_intervals(method.options, zeta, method.spring))
          intervals.push_back({method.name, zeta, interval});
  return intervals;
}

CsvTable maps_csv(const std::vector<StabilityMap> &maps)
{
  CsvTable csv({"method", "damping ratio [1]", "omega h [1]", "spectral radius [1]", "period elongation [1]",
                "numerical damping [1]", "overshoot displacement [1]", "overshoot velocity [1]"});
  for (const StabilityMap &map : maps)
    for (std::size_t i = 0; i < map.omega_h.size(); ++i)
      csv.add(map.method, map.zeta, map.omega_h[i], map.step[i].spectral_radius, map.step[i].period_elongation,
              map.step[i].numerical_damping, map.displaced[i].displacement, map.displaced[i].velocity);
  return csv;
}

std::vector<NamedSvg> stability_charts(const std::vector<MethodFamily> &families, const std::vector<StabilityMap> &maps,
                                       double zeta, const std::vector<coupling::ModeAccuracy> &modes)
{
  const double      nan = std::numeric_limits<double>::quiet_NaN();
  const std::string at  = ", damping ratio " + short_text(zeta);
  Chart             radius{"Spectral radius" + at};
  radius.x       = {"ω h", lowest, highest, Scale::logarithmic};
  radius.y       = {"spectral radius", 0., 2.};
  radius.marks   = marks_of(modes);
  radius.panels  = {};
  radius.width   = 440.;
  radius.height  = 250.;
  radius.columns = 2;
  const auto on_logarithmic =
      [&](const std::string &title, const std::string &label, double x_end, double from, double to)
  {
    Chart chart = radius;
    chart.title = title + at;
    chart.x.end = x_end;
    chart.y     = {label, from, to, Scale::logarithmic};
    return chart;
  };
  Chart period    = on_logarithmic("Period error (dashed: too fast)", "relative", 10., 1e-10, 10.);
  Chart damping   = on_logarithmic("Numerical damping (dashed: negative)", "damping ratio", 10., 1e-10, 1.);
  Chart overshoot = on_logarithmic("Overshoot after an initial displacement, 20 steps", "ratio to the initial value",
                                   highest, 1., 1e6);
  radius.shades   = {{1., radius.y.end, 1}};

  for (const MethodFamily &family : families)
  {
    for (Chart *chart : {&radius, &period, &damping, &overshoot})
      chart->panels.push_back({family.title, {}});
    for (std::size_t m = 0; m < family.methods.size(); ++m)
    {
      const StabilityMap *map = map_of(maps, family.methods[m].name, zeta);
      if (!map)
        continue;
      std::vector<double> rho, elongation, ratio, peak;
      for (std::size_t i = 0; i < map->omega_h.size(); ++i)
      {
        rho.push_back(map->step[i].spectral_radius);
        const bool seen = map->omega_h[i] < M_PI; // two steps in a period: beyond it, no root follows the motion
        elongation.push_back(seen ? map->step[i].period_elongation : nan);
        ratio.push_back(seen ? map->step[i].numerical_damping : nan);
        peak.push_back(std::max(map->displaced[i].displacement, map->displaced[i].velocity));
      }
      const int colour = static_cast<int>(m);
      radius.panels.back().curves.push_back({map->method, map->omega_h, rho, colour});
      overshoot.panels.back().curves.push_back({map->method, map->omega_h, peak, colour});
      add_signed(period.panels.back(), *map, elongation, colour);
      add_signed(damping.panels.back(), *map, ratio, colour);
    }
  }
  return {{"spectral-radius", chart_svg(radius)},
          {"period-error", chart_svg(period)},
          {"numerical-damping", chart_svg(damping)},
          {"overshoot", chart_svg(overshoot)}};
}

} // namespace gestell::apps

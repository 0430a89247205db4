// Methods for which an undamped or lightly damped linear mode grows.

#include "apps/atlas/atlas.h"
#include "apps/atlas/trials.h"
#include "apps/output/charts/chart.h"
#include "coupling/integration/propagation/force_rule.h"
#include "coupling/integration/stability/overshoot.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

using coupling::ForceRule;
using coupling::MethodOptions;
using coupling::options_of;
using coupling::Spring;
using coupling::TestOscillator;

// The results of the integrators differ from the formulas only by rounding, 1e-16 of the state in every step, over some
// hundred steps; the other roots have decayed by then (to 0.99^1000 at most).
constexpr double rounding = 1e-7;

MethodOptions bdf_options(int order)
{
  return options_of("bdf", order);
}

MethodOptions newmark(double beta, double gamma)
{
  return options_of("newmark").with("beta", beta).with("gamma", gamma);
}

MethodOptions wilson(double theta)
{
  return options_of("wilson").with("theta", theta);
}

MethodOptions exact(ForceRule force, int order)
{
  return options_of("exact", order).with("force", force_rule_name(force));
}

/// The method at omega h on a unit oscillator: spectral radius from the roots, and growth of the steps.
AtlasComparison compare(const std::string &name, MethodOptions options, const TestOscillator &o)
{
  options.step           = 1.;
  const double predicted = coupling::spectral_radius(options, o);
  const int    n         = steps_to_see(predicted);
  auto machine = o.spring == Spring::contact ? contact_oscillator(o.omega_h) : trial_frame({{o.omega_h, o.zeta}});
  return {name + " at omega h = " + short_text(o.omega_h), predicted,
          measured_growth(step_through(machine, options, n).col(0)), rounding};
}

struct Trial
{
  std::string         name;
  MethodOptions       options;
  double              zeta;
  std::vector<double> omega_h; ///< where it is measured
  Spring              spring = Spring::base;
};

/// Growth per step over a step or omega h; above 1 the paper is shaded.
Chart growth_chart(const std::string &title, const ChartAxis &x, double bottom, double top)
{
  Chart chart{title, "", x, {"growth per step", bottom, top}};
  chart.shades = {{1., top, 1}};
  return chart;
}

/// Growth over omega h: lines predicted, rings measured.
AtlasEntry growth_entry(AtlasEntry entry, const std::vector<Trial> &trials, double from, double to, double top)
{
  Chart  chart = growth_chart(entry.title, {"ω h", from, to, Scale::logarithmic}, 0.9, top);
  Panel &panel = chart.panels.front();
  for (std::size_t i = 0; i < trials.size(); ++i)
  {
    const Trial &trial  = trials[i];
    const int    colour = static_cast<int>(i);
    Curve        predicted{trial.name, {}, {}, colour}, measured = rings(i == 0 ? "measured" : "", colour);
    for (int k = 0; k <= 400; ++k)
    {
      predicted.x.push_back(from * std::pow(to / from, k / 400.));
      predicted.y.push_back(coupling::spectral_radius(trial.options, {trial.zeta, predicted.x.back(), trial.spring}));
    }
    for (const double omega_h : trial.omega_h)
    {
      entry.comparisons.push_back(compare(trial.name, trial.options, {trial.zeta, omega_h, trial.spring}));
      measured.add(omega_h, entry.comparisons.back().measured);
    }
    panel.curves.push_back(predicted);
    panel.curves.push_back(measured);
  }
  entry.figures.push_back({entry.id, chart_svg(chart)});
  return entry;
}

} // namespace

AtlasEntry bdf3_on_a_frame()
{
  constexpr double          zeta  = 0.01; // of welded frames
  const std::vector<double> hertz = {20., 60., 150., 400.};
  std::vector<TrialMass>    masses;
  for (const double f : hertz)
    masses.push_back({two_pi * f, zeta});

  AtlasEntry entry{
      "bdf3-frame",
      "BDF 3 on a frame with 1 % damping",
      "Four modes, 20, 60, 150 and 400 Hz, with a damping ratio of 1 %. BDF 3 amplifies a mode with 1 % damping for "
      "0.3567 < ω h < 1.863. If the frequencies of a frame span more than a decade, every useful step has such a mode. "
      "Growth of the worst mode, predicted by the roots and measured in a run:",
      {},
      {{"step", "mode that grows fastest", "predicted", "measured"}},
      {}};
  Chart      chart = growth_chart(entry.title, {"step in s", 1e-4, 1e-2, Scale::logarithmic}, 0.99, 1.045);
  Curve      line{"predicted, of the worst mode"}, seen = rings("measured", 1);
  const auto worst = [&](double h)
  {
    std::size_t best = 0;
    double      most = 0.;
    for (std::size_t i = 0; i < masses.size(); ++i)
      if (const double rho = coupling::spectral_radius(bdf_options(3), {zeta, masses[i].omega * h}); rho > most)
        most = rho, best = i;
    return std::pair(best, most);
  };
  for (int k = 0; k <= 400; ++k)
  {
    line.x.push_back(1e-4 * std::pow(100., k / 400.));
    line.y.push_back(worst(line.x.back()).second);
  }
  for (const double h : {2e-4, 4e-4, 7e-4, 1.2e-3, 2e-3, 3e-3, 5e-3, 8e-3})
  {
    const auto [mode, predicted] = worst(h);
    MethodOptions options        = bdf_options(3);
    options.step                 = h;
    auto         machine         = trial_frame(masses);
    const double measured = measured_growth(step_through(machine, options, steps_to_see(predicted)).col(long(mode)));
    entry.comparisons.push_back({"BDF 3, step " + short_text(1e3 * h) + " ms", predicted, measured, rounding});
    entry.table.push_back({short_text(1e3 * h) + " ms", short_text(hertz[mode]) + " Hz", short_text(predicted, 8),
                           short_text(measured, 8)});
    seen.add(h, measured);
  }
  chart.panels.front().curves = {line, seen};
  entry.figures.push_back({entry.id, chart_svg(chart)});
  return entry;
}

AtlasEntry bdf_of_high_order()
{
  return growth_entry({"bdf-high-order",
                       "BDF 4, 5 and 6 on an undamped mode",
                       "BDF 4 grows for every ω h > 0, at first slowly, by (ω h)⁶/3 per step; BDF 5 and 6 grow above "
                       "0.711 and 0.843. Only damping ratios of 0.286, 0.618 and 0.952 would make them stable for "
                       "every step. With a controlled step Gestell lowers the order before a mode grows.",
                       {},
                       {},
                       {}},
                      {{"BDF 4", bdf_options(4), 0., {0.5, 0.8, 1.2, 1.8604, 3., 4.5}},
                       {"BDF 5", bdf_options(5), 0., {0.8, 1.2, 2.384, 4., 8.}},
                       {"BDF 6", bdf_options(6), 0., {0.9, 1.5, 2.791, 5., 12.}}},
                      0.1, 30., 1.65);
}

AtlasEntry wilson_below_its_limit()
{
  return growth_entry({"wilson-limit",
                       "Wilson below θ = (1 + √3)/2",
                       "Wilson's method is stable for every step if θ ≥ 1.3660254. The rounded value 1.366025 grows "
                       "for ω h > 2929, θ = 1.3 for ω h > 7.385; θ = 1 is linear acceleration with the limit 2√3.",
                       {},
                       {},
                       {}},
                      {{"θ = 1", wilson(1.), 0., {3.6, 4.5}},
                       {"θ = 1.2", wilson(1.2), 0., {6., 10., 40.}},
                       {"θ = 1.3", wilson(1.3), 0., {8., 12., 30., 200.}},
                       {"θ = 1.4", wilson(1.4), 0., {}}},
                      1., 1000., 1.8);
}

AtlasEntry newmark_outside_its_limits()
{
  return growth_entry(
      {"newmark-limits",
       "Newmark with γ < 1/2, linear acceleration, central differences",
       "γ < 1/2 amplifies every undamped mode, |r|² = 1 + (1/2 - γ)(ω h)²/(1 + β (ω h)²). Linear acceleration (β = "
       "1/6) is stable up to ω h = 2√3, central differences up to 2, for any damping.",
       {},
       {},
       {}},
      {{"γ = 0.45, β = 0.25", newmark(0.25, 0.45), 0., {0.3, 1., 3., 20.}},
       {"linear acceleration", newmark(1. / 6., 0.5), 0., {3.5, 3.8, 4.5}},
       {"central differences", options_of("central-difference"), 0., {2.01, 2.1, 2.2}},
       {"central differences, ζ = 0.05", options_of("central-difference"), 0.05, {2.01, 2.1, 2.2}}},
      0.1, 100., 1.8);
}

AtlasEntry exact_force_at_contact()
{
  return growth_entry(
      {"exact-contact",
       "Exact propagation with a linear force at a stiff contact",
       "The base system is exact for every step; only a closed contact can grow, because its force is interpolated. "
       "For a free mass with the stiffness of the contact, the linear force is stable up to ω_c h = 2√3, collocation "
       "of order 2 up to 2√2. Order 4 grows for 3 < ω_c h < 2√3 and above 6, order 6 for 3.1262 < ω_c h < √10, order 8 "
       "for 3.1409 < ω_c h < 3.1425, each then in wider islands. Orders 4 and above are therefore stable below ω_c h = "
       "3. The average force conserves the energy of the contact and is stable for every step.",
       {},
       {},
       {}},
      {{"average force", exact(ForceRule::average, 2), 0., {1.5, 3., 6., 15.}, Spring::contact},
       {"linear force", exact(ForceRule::linear, 2), 0., {3.5, 3.8, 4.4}, Spring::contact},
       {"collocation 2", exact(ForceRule::collocation, 2), 0., {2.85, 3.05}, Spring::contact},
       {"collocation 4", exact(ForceRule::collocation, 4), 0., {3.1, 3.23, 3.4, 6.02}, Spring::contact},
       {"collocation 6", exact(ForceRule::collocation, 6), 0., {3.145, 5.9, 7.7, 9.95}, Spring::contact},
       {"collocation 8", exact(ForceRule::collocation, 8), 0., {3.1417, 6.2, 6.31, 8.81, 13.}, Spring::contact}},
      1., 20., 1.8);
}

AtlasEntry wilson_overshoot()
{
  AtlasEntry entry{"wilson-overshoot",
                   "Wilson's overshoot",
                   "With θ = 1.4 nothing grows. But a stiff mode with an initial displacement jumps to (ω h)²/7 times "
                   "this displacement within one step. A contact that closes has this effect, and so has any initial "
                   "state that is not in equilibrium in a stiff mode. Largest |x| of the first 20 steps:",
                   {},
                   {{"ω h", "predicted", "measured"}},
                   {}};
  Chart      chart{
      entry.title, "", {"ω h", 0.1, 1000., Scale::logarithmic}, {"largest |x| / x₀", 0.8, 1e6, Scale::logarithmic}};
  Curve line{"Wilson 1.4, predicted"}, other{"BDF 2", {}, {}, 1}, seen = rings("measured", 0);
  for (int k = 0; k <= 300; ++k)
  {
    const TestOscillator o{0., 0.1 * std::pow(1e4, k / 300.)};
    line.add(o.omega_h, coupling::overshoot(wilson(1.4), o, coupling::OscillatorStart::displaced).displacement);
    other.add(o.omega_h, coupling::overshoot(bdf_options(2), o, coupling::OscillatorStart::displaced).displacement);
  }
  for (const double omega_h : {1., 3., 10., 30., 100., 1000.})
  {
    MethodOptions options = wilson(1.4);
    options.step          = 1.;
    auto         machine  = trial_frame({{omega_h, 0.}});
    const double predicted =
        coupling::overshoot(options, {0., omega_h}, coupling::OscillatorStart::displaced).displacement;
    const double measured = step_through(machine, options, 20).cwiseAbs().maxCoeff();
    // Only rounding, amplified by the ratio of h^2 a to x, (omega h)^2, in the first step.
    entry.comparisons.push_back(
        {"Wilson 1.4 at omega h = " + short_text(omega_h), predicted, measured, 1e-9 * std::max(1., predicted)});
    entry.table.push_back({short_text(omega_h), short_text(predicted, 7), short_text(measured, 7)});
    seen.add(omega_h, measured);
  }
  chart.panels.front().curves = {line, seen, other};
  entry.figures.push_back({entry.id, chart_svg(chart)});
  return entry;
}

} // namespace gestell::apps

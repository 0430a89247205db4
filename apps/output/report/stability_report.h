#pragma once

#include "apps/output/charts/stability_maps.h"
#include "apps/output/values/coupling_descriptions.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Stability check of a method with the modes and the step of a scene.
struct MethodVerdict
{
  std::string method;
  int         growing              = 0;     ///< number of unstable modes
  bool        only_closed          = false; ///< exact propagation with closed contacts: the run only prints a warning
  double      growth               = 1.;    ///< growth factor of the worst mode per step
  double      worst_hz             = 0.;
  double      step_that_works      = 0.; ///< [s] largest smaller step at which no mode grows; 0: none
  double      lowest_period_error  = 0.; ///< of the lowest mode of the frame
  double      highest_period_error = 0.; ///< of its highest
};

template <class Visitor>
void describe(Visitor &v, const MethodVerdict &x)
{
  using Known = std::optional<double>;
  v("method", x.method, "", "with its parameters");
  v("verdict",
    x.growing == 0  ? "stable"
    : x.only_closed ? "grows while contacts are closed"
                    : "unstable",
    "", "of all modes");
  v("growing_modes", x.growing, "", "modes that grow");
  v("growth_per_step", x.growth, "1", "of the worst mode");
  v("worst_hz", x.growing > 0 ? Known(x.worst_hz) : Known(), "Hz", "frequency of the worst mode; null: none grows");
  v("step_that_works_s", x.growing > 0 && x.step_that_works > 0. ? Known(x.step_that_works) : Known(), "s",
    "largest smaller step at which no mode grows; null: none, or not needed");
  v("lowest_period_error", x.lowest_period_error, "1", "relative, of the frame's lowest mode; positive: too slow");
  v("highest_period_error", x.highest_period_error, "1", "of its highest mode");
}

/// Result of `gestell stability`.
struct StabilityStudy
{
  std::string                                           title, version;
  std::vector<double>                                   zetas;
  std::vector<MappedInterval>                           intervals;
  std::vector<std::pair<double, std::vector<NamedSvg>>> charts; ///< by damping ratio

  // of a scene; empty without one
  std::string                         method; ///< with its step
  std::vector<coupling::ModeAccuracy> modes;
  std::vector<MethodVerdict>          verdicts;
  std::vector<std::string>            notes;
};

template <class Visitor>
void describe(Visitor &v, const StabilityStudy &x)
{
  v("damping_ratios", x.zetas, "1", "of the maps");
  v("unstable_intervals", x.intervals, "", "where each method grows");
  v("method", x.method, "", "of the scene, with its step; empty without a scene");
  v("modes", x.modes, "", "of the scene under its method");
  v("methods", x.verdicts, "", "at the scene's step");
  v("notes", x.notes, "", "texts");
}

/// The study as JSON text, for `--json` and Python.
std::string stability_answer(const StabilityStudy &study);

/// One self-contained page: the scene's modes, other methods at its step, stability maps, unstable intervals.
std::string stability_page(const StabilityStudy &study);

/// The scene's part for a terminal: at most 40 modes, always including those that grow.
std::string stability_text(const StabilityStudy &study);

} // namespace gestell::apps

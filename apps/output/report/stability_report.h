#pragma once

#include "apps/output/charts/stability_maps.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// A method laid over the modes of a scene at its step.
struct MethodVerdict
{
  std::string method;
  int         growing         = 0;     ///< modes that grow
  bool        only_closed     = false; ///< those of closed contacts under exact propagation: a run warns, and goes on
  double      growth          = 1.;    ///< of the worst, per step
  double      worst_hz        = 0.;
  double      step_that_works = 0.;      ///< [s] if any mode grows: the largest below; 0: none
  double      lowest_period_error  = 0.; ///< of the lowest mode of the frame
  double      highest_period_error = 0.; ///< of its highest
};

/// What `gestell stability` found.
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

/// One self-contained page: the scene's modes, other methods at its step, maps, unstable intervals.
std::string stability_page(const StabilityStudy &study);

/// The scene's part for a terminal; at most 40 modes, those that grow always.
std::string stability_text(const StabilityStudy &study);

} // namespace gestell::apps

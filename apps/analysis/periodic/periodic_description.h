#pragma once

#include "apps/output/describe/described.h"
#include "apps/output/values/coupling_descriptions.h"
#include "apps/output/values/periodic_result.h"

#include <array>
#include <cmath>

namespace gestell::apps
{

/// A solution with the fields that depend on the whole result.
struct DescribedMotion
{
  const PeriodicResult *result = nullptr;
  const PeriodicEntry  *entry  = nullptr;
};

template <class Visitor>
void describe(Visitor &v, const DescribedMotion &x)
{
  const PeriodicEntry                entry = x.entry ? *x.entry : PeriodicEntry();
  const coupling::PeriodicSolution  &s     = entry.solution;
  std::vector<std::array<double, 2>> multipliers;
  for (const auto &mu : s.multipliers)
    multipliers.push_back({mu.real(), mu.imag()});
  std::vector<std::pair<std::string, std::vector<double>>> initial;
  for (Eigen::Index i = 0; i < s.q.size(); ++i)
  {
    const auto &[name, sign] = x.result->coordinates[std::size_t(i)];
    initial.push_back({name, {sign * s.q[i], sign * s.v[i]}});
  }
  v("period", s.period, "s", "period of the solution");
  v("ratio", s.ratio, "", "periods of the excitation per period of the solution");
  v("residual", s.residual, "1", "periodicity residual, relative");
  v("branch", entry.branch, "", "number of the branch");
  v("kind", kind_of(s), "", "periodic or sub-harmonic");
  v("method", s.method, "", "method that found it");
  v("events", s.events.size(), "", "events in a period");
  v("notes", s.notes, "", "texts");
  v("stable", s.stability_is_known() ? std::optional(s.stable()) : std::nullopt, "", "null: not known");
  v.maybe(s.verification.periods > 0, "verification", s.verification, "", "verification by a run of the scene");
  v.maybe(x.result && !x.result->parameter.empty(), "parameter", entry.parameter, "",
          "value of the continuation parameter");
  v.maybe(!std::isnan(s.share), "share", s.share, "1", "share of the initial states that led there");
  v("multipliers", multipliers, "1", "Floquet multipliers, real and imaginary part");
  v("signals", by_name(entry.signals, &SignalOrbit::name), "", "each signal over a period");
  v("initial", initial, "", "value and rate of each coordinate at the start, in the form of `[start]`");
}

/// A point of the backbone.
struct BackbonePoint
{
  double                                      parameter = 0., frequency_hz = 0.;
  std::vector<std::pair<std::string, double>> amplitudes{};
};

template <class Visitor>
void describe(Visitor &v, const BackbonePoint &x)
{
  v("parameter", x.parameter, "", "value of the parameter");
  v("frequency_hz", x.frequency_hz, "Hz", "of free vibration");
  v("amplitudes", x.amplitudes, "", "first harmonic of each signal");
}

/// An axis of the plane of initial states.
struct PlaneAxis
{
  std::string name{};
  double      from = 0., to = 0.;
};

template <class Visitor>
void describe(Visitor &v, const PlaneAxis &x)
{
  v("name", x.name, "", "coordinate, or its rate, marked by '");
  v("from", x.from, "", "first value");
  v("to", x.to, "", "last value");
}

template <class Visitor>
void describe(Visitor &v, const BasinMap &x)
{
  const coupling::StartPlane                 &plane = x.basins.plane;
  std::vector<std::pair<std::string, double>> shares;
  const int                                   most = x.basins.motion.size() > 0 ? x.basins.motion.maxCoeff() : -1;
  for (int number = 0; number <= most; ++number)
    if (x.basins.share(number) > 0.)
      shares.emplace_back(std::to_string(number), x.basins.share(number));
  v("x", PlaneAxis{x.x_name, plane.x_begin, plane.x_end}, "", "first axis of the initial states");
  v("y", PlaneAxis{x.y_name, plane.y_begin, plane.y_end}, "", "second axis");
  v("points", plane.points, "", "initial states along each axis");
  v("shares", shares, "1", "share of the initial states for each solution number; 0: none of them");
  v("complete", x.basins.is_complete(), "", "whether every initial state was examined");
}

template <class Visitor>
void describe(Visitor &v, const PeriodicResult &x)
{
  std::vector<DescribedMotion> motions;
  for (const PeriodicEntry &entry : x.entries)
    motions.push_back({&x, &entry});
  std::vector<BackbonePoint> backbone;
  for (const PeriodicEntry &entry : x.backbone)
  {
    backbone.push_back({entry.parameter, 1. / entry.solution.period});
    for (const SignalOrbit &signal : entry.signals)
      backbone.back().amplitudes.emplace_back(signal.name, signal.amplitude.at(0));
  }
  v("method", x.method, "", "method of the search");
  v("reason", x.reason, "", "reason for this method");
  v("notes", x.notes, "", "texts");
  v("interrupted", x.interrupted, "", "the search was interrupted");
  v("failure", unless_empty(x.failure), "", "reason for an early end; null: none");
  v.maybe(!x.parameter.empty(), "parameter",
          std::vector<std::pair<std::string, std::string>>{{"key", x.parameter}, {"unit", x.parameter_unit}}, "",
          "continuation parameter");
  v("solutions", motions, "", "periodic solutions found");
  v("special_points", x.special_points, "", "points where solutions begin, end or change their stability");
  v.maybe(x.long_run.has_value(), "recurrence", x.long_run ? x.long_run->motion : coupling::Recurrence(), "",
          "long-term behaviour");
  v.maybe(x.basins.has_value(), "basins", x.basins, "", "basins of attraction");
  v.maybe(!backbone.empty(), "backbone", backbone, "",
          "backbone curve of free vibration, if the parameter is a load frequency");
  v("checks", x.checks, "", "checks by a second method");
  v("work", x.work, "", "work of the search");
}

} // namespace gestell::apps

#pragma once

#include "apps/output/describe/described.h"
#include "apps/output/values/coupling_descriptions.h"
#include "apps/output/values/result.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::apps
{

inline std::vector<Eigen::Vector3d> rows_of(const Eigen::Matrix3d &matrix)
{
  return {matrix.row(0), matrix.row(1), matrix.row(2)};
}

template <class Visitor>
void describe(Visitor &v, const ModelFacts &x)
{
  const auto count = [&](const char *name, int n, const char *meaning) { v.maybe(n >= 0, name, n, "", meaning); };
  count("dofs", x.dofs, "coordinates integrated");
  count("interface", x.interface, "coordinates q1 of the frame");
  count("modes", x.modes, "internal modes retained");
  count("nonlinear", x.nonlinear, "measures of nonlinear elements");
  count("frame_dofs", x.frame_dofs, "coordinates of the unreduced frame");
  count("cells", x.cells, "finite elements");
  v("frame_mass", x.frame_mass, "kg", "mass of the frame");
  v("frequency_error", x.frequency_error, "1", "largest relative error of a frequency by the reduction, estimated");
  v("static_residual", x.static_residual, "1", "part of the static load on q2 that the modes do not carry");
  v.maybe(!std::isnan(x.frequency_limit), "frequency_limit_hz", x.frequency_limit, "Hz",
          "up to which a reduced frame is made to hold");
  const bool cells = x.frame.whole.mass > 0., frame = !x.damping.empty();
  v.maybe(cells, "centre", x.frame.whole.centre, "m", "centre of mass of the frame");
  v.maybe(cells, "inertia", rows_of(x.frame.whole.inertia), "kg m^2", "inertia about it, rows of the tensor");
  v.maybe(cells, "parts", x.frame.parts, "", "solids and attached masses");
  v.maybe(cells, "rigid_energy", x.frame.rigid_energy, "1",
          "share of elastic energies that does not cancel in a rigid motion of the frame without supports");
  v.maybe(frame, "free_motions", x.free_motions, "", "modes of frequency zero");
  v.maybe(frame, "free_motion_names", x.frame.free_motions, "", "names of these motions");
  v.maybe(frame, "damping", x.damping, "", "of the frame, a text");
  v.maybe(frame && !x.mesh.empty(), "mesh", x.mesh, "", "what is not known of its mesh");
  v.maybe(frame, "statements", x.statements, "", "what was checked of the frame and holds");
}

template <class Visitor>
void describe(Visitor &v, const Request &x)
{
  v("file", x.file, "", "of the scene, as it was given");
  v("set", x.set, "", "entries overridden on the command line");
  const coupling::RunOptions run = x.run.value_or(coupling::RunOptions());
  v.maybe(x.run.has_value(), "method", x.run ? coupling::method_name(run.method) : "", "", "method of integration");
  v.maybe(x.run.has_value(), "tolerance", unless_zero(run.method.tolerance), "1", "null: the step is fixed");
  v.maybe(x.run.has_value(), "step", unless_zero(run.method.step), "s", "null: the step is controlled");
  v.maybe(x.run.has_value(), "begin", run.begin, "s", "start of the run");
  v.maybe(x.run.has_value(), "end", run.end, "s", "end asked for");
  v.maybe(x.run.has_value(), "from", std::max(run.from, run.begin), "s", "where extremes begin to count");
  v.maybe(x.run.has_value(), "events", run.events, "", "events are located");
}

template <class Visitor>
void describe(Visitor &v, const PeakState &x)
{
  v("signal", x.signal, "", "its name");
  v("value", x.value, x.unit, "its extreme");
  v("unit", x.unit, "", "of `value`");
  v("t", x.t, "s", "instant of the extreme");
  v("half_swing", x.half_swing > 0. ? std::optional(x.half_swing) : std::nullopt, "s",
    "to the turning point beside it; null: there is none");
}

/// Energy shares of a coupled mode.
struct ModeEnergies
{
  std::vector<std::pair<std::string, double>> strain{}, kinetic{};
};

template <class Visitor>
void describe(Visitor &v, const ModeEnergies &x)
{
  v("strain", x.strain, "1", "share of each spring");
  v("kinetic", x.kinetic, "1", "share of each body");
}

inline std::vector<ModeEnergies> mode_energies(const coupling::EnergyShares &shares)
{
  std::vector<ModeEnergies> modes;
  for (Eigen::Index j = 0; j < shares.kinetic.cols(); ++j)
    modes.push_back({pairs_of(shares.springs, shares.strain.col(j)), pairs_of(shares.masses, shares.kinetic.col(j))});
  return modes;
}

/// Outcome of a run.
struct Outcome
{
  std::string method{};
  double      begin = 0., end = 0.; ///< [s] of the output rows
  std::size_t events_located = 0;
  bool        complete = false, interrupted = false;
  std::string failure{};
};

template <class Visitor>
void describe(Visitor &v, const Outcome &x)
{
  v("method", x.method, "", "that ran");
  v("begin", x.begin, "s", "start of the run");
  v("end", x.end, "s", "end that it reached");
  v("events_located", x.events_located, "", "number of events");
  v("complete", x.complete, "", "the run came to its end");
  v("interrupted", x.interrupted, "", "the run was interrupted");
  v("failure", unless_empty(x.failure), "", "why it stopped early; null: it did not");
}

inline Outcome outcome_of(const coupling::RunResult &run, const Request &requested)
{
  const std::size_t width = run.columns.size(), last_row = run.rows.size() - width;
  const bool        rows  = width > 0 && run.rows.size() >= width;
  const double      begin = requested.run ? requested.run->begin : 0.;
  return {run.method,        rows ? run.rows.front() : begin,         rows ? run.rows[last_row] : begin,
          run.events.size(), run.failure.empty() && !run.interrupted, run.interrupted,
          run.failure};
}

/// summary.json
template <class Visitor>
void describe(Visitor &v, const Result &x)
{
  // A result without a run has no signals, but has all members, so that readers need no case distinction.
  static const coupling::RunResult none;
  const coupling::RunResult       &run = x.run ? *x.run : none;
  const auto frequencies               = [](const std::vector<coupling::Mode> &modes, double coupling::Mode::*of)
  {
    std::vector<double> f;
    for (const coupling::Mode &mode : modes)
      f.push_back(mode.*of);
    return f;
  };
  const auto part = [&v](const char *name, const auto &value, const char *meaning)
  { v.maybe(value.has_value(), name, value, "", meaning); };
  const bool keeps_energy = std::count(run.columns.begin(), run.columns.end(), "energy input") > 0 ||
                            run.energy.exchanged > 0. || run.energy.residual > 0.;

  v("scene", x.scene, "", "name of the scene");
  v("version", x.version, "", "of the program");
  v("commit", unless_empty(x.commit), "", "the program was built from; null: without a repository");
  v("command", x.command, "", "of the program");
  v("asked", x.requested, "", "what was asked for");
  v.maybe(x.run.has_value(), "outcome", outcome_of(run, x.requested), "", "how the run went");
  v("model", x.model, "", "size and accuracy of the model");
  v("bodies_from_cad", x.bodies_from_cad, "", "texts: file, mass, centre and inertia of each body read from CAD");
  v("frequencies_hz",
    frequencies(x.coupled_modes.empty() ? x.frame_modes : x.coupled_modes, &coupling::Mode::frequency_hz), "Hz",
    "undamped, of the coupled machine; of the frame where there is no machine");
  v("frame_frequencies_hz", frequencies(x.frame_modes, &coupling::Mode::frequency_hz), "Hz",
    "undamped, of the frame alone as it is supported");
  v("frame_refined_frequencies_hz", frequencies(x.frame_modes, &coupling::Mode::refined_hz), "Hz",
    "the same by one more step of inverse iteration, nearer to those of the whole mesh; null: not known");
  v("operating_poles", x.poles, "", "of a machine with drives, at the speeds of the start");
  v.maybe(x.energy_shares.has_value(), "mode_energies",
          mode_energies(x.energy_shares.value_or(coupling::EnergyShares())), "",
          "shares of the energies of each coupled mode");
  for (const auto &answer : x.answers)
    answer->describe(v);
  part("size", x.size, "`size`");
  part("story", x.story, "of a run with events");
  part("stress", x.stress, "`[output.stress]`");
  part("main_peak", x.peak, "extreme of the first signal in N, else of the first of all, that is larger");
  v("signals", by_name(run.signals, &coupling::SignalSummary::name), "", "extremes of each signal");
  v("events", run.events, "", "in the order of time");
  v("method", run.method, "", "method of integration with its parameters");
  v("accuracy", run.accuracy, "",
    "what the method with its fixed step makes of each mode; empty with a controlled step");
  v("work", run.work, "", "of the integration");
  v("wall_s", x.wall_s, "s", "by phase; `program`: CPU time until the scene is read");
  v("energy", keeps_energy ? std::optional(run.energy) : std::nullopt, "", "null: no balance was kept");
  v("warnings", all_warnings(x), "", "texts of all findings");
  v("findings", all_findings(x), "", "warnings, and why a run stopped early");
  v("units", std::vector<std::pair<std::string, std::string>>(), "",
    "unit of each member that has the same in all results, by its path as it stands here; the others have a member "
    "`unit` beside them");
}

} // namespace gestell::apps

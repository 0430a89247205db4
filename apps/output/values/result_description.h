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
  count("dofs", x.dofs, "DOFs of the time integration");
  count("interface", x.interface, "interface DOFs q1 of the frame");
  count("modes", x.modes, "retained internal modes");
  count("nonlinear", x.nonlinear, "measures of nonlinear elements");
  count("frame_dofs", x.frame_dofs, "DOFs of the unreduced frame");
  count("cells", x.cells, "finite elements");
  v("frame_mass", x.frame_mass, "kg", "mass of the frame");
  v("frequency_error", x.frequency_error, "1", "largest estimated relative error of a frequency due to the reduction");
  v("static_residual", x.static_residual, "1", "share of the static load on q2 that the modes do not represent");
  v.maybe(!std::isnan(x.frequency_limit), "frequency_limit_hz", x.frequency_limit, "Hz",
          "frequency up to which the reduced frame is valid");
  const bool cells = x.frame.whole.mass > 0., frame = !x.damping.empty();
  v.maybe(cells, "centre", x.frame.whole.centre, "m", "centre of mass of the frame");
  v.maybe(cells, "inertia", rows_of(x.frame.whole.inertia), "kg m^2", "inertia about the centre, rows of the tensor");
  v.maybe(cells, "parts", x.frame.parts, "", "solids and attached masses");
  v.maybe(cells, "rigid_energy", x.frame.rigid_energy, "1",
          "relative elastic energy of rigid-body displacements of the unsupported frame; rounding error only");
  const std::optional<double> &buckling = x.frame.buckling_factor;
  v.maybe(buckling.has_value(), "buckling_factor",
          buckling && std::isfinite(*buckling) ? buckling : std::optional<double>(), "1",
          "factor of the loads of `frame.prestress` at which the frame buckles, an upper bound for a frame of parts or "
          "in parts; null: tension dominates, the frame does not buckle");
  v.maybe(frame, "free_motions", x.free_motions, "", "number of rigid-body modes");
  v.maybe(frame, "free_motion_names", x.frame.free_motions, "", "names of the rigid-body modes");
  v.maybe(frame, "damping", x.damping, "", "damping of the frame, as text");
  v.maybe(frame && !x.mesh.empty(), "mesh", x.mesh, "", "remarks about the mesh");
  v.maybe(frame, "statements", x.statements, "", "checks of the frame that passed");
}

template <class Visitor>
void describe(Visitor &v, const Request &x)
{
  v("file", x.file, "", "path of the scene as given");
  v("set", x.set, "", "keys overridden on the command line");
  const coupling::RunOptions run = x.run.value_or(coupling::RunOptions());
  v.maybe(x.run.has_value(), "method", x.run ? coupling::method_name(run.method) : "", "", "method of integration");
  v.maybe(x.run.has_value(), "tolerance", unless_zero(run.method.tolerance), "1", "null: the step is fixed");
  v.maybe(x.run.has_value(), "step", unless_zero(run.method.step), "s", "null: the step is controlled");
  v.maybe(x.run.has_value(), "begin", run.begin, "s", "start of the run");
  v.maybe(x.run.has_value(), "end", run.end, "s", "requested end");
  v.maybe(x.run.has_value(), "from", std::max(run.from, run.begin), "s", "start of the window for extremes");
  v.maybe(x.run.has_value(), "events", run.events, "", "whether events are located");
}

template <class Visitor>
void describe(Visitor &v, const PeakState &x)
{
  v("signal", x.signal, "", "name of the signal");
  v("value", x.value, x.unit, "extreme value");
  v("unit", x.unit, "", "of `value`");
  v("t", x.t, "s", "instant of the extreme");
  v("half_swing", x.half_swing > 0. ? std::optional(x.half_swing) : std::nullopt, "s",
    "half-period: time to the neighbouring turning point; null: none");
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
  v("method", x.method, "", "method of integration used");
  v("begin", x.begin, "s", "start of the run");
  v("end", x.end, "s", "end reached");
  v("events_located", x.events_located, "", "number of events");
  v("complete", x.complete, "", "whether the run reached its end");
  v("interrupted", x.interrupted, "", "whether the run was interrupted");
  v("failure", unless_empty(x.failure), "", "reason for an early stop; null: none");
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
  v("version", x.version, "", "version of the program");
  v("commit", unless_empty(x.commit), "", "commit from which the program was built; null: unknown");
  v("command", x.command, "", "name of the command");
  v("asked", x.requested, "", "request");
  v.maybe(x.run.has_value(), "outcome", outcome_of(run, x.requested), "", "outcome of the run");
  v("model", x.model, "", "size and accuracy of the model");
  v("bodies_from_cad", x.bodies_from_cad, "", "file, mass, centre and inertia of each body from CAD, as text");
  v("frequencies_hz",
    frequencies(x.coupled_modes.empty() ? x.frame_modes : x.coupled_modes, &coupling::Mode::frequency_hz), "Hz",
    "undamped frequencies of the coupled machine, or of the frame if there is no mechanism");
  v("frame_frequencies_hz", frequencies(x.frame_modes, &coupling::Mode::frequency_hz), "Hz",
    "undamped frequencies of the supported frame alone");
  v("frame_refined_frequencies_hz", frequencies(x.frame_modes, &coupling::Mode::refined_hz), "Hz",
    "the same after one more step of inverse iteration, closer to those of the whole mesh; null: unknown");
  v("operating_poles", x.poles, "", "poles of a machine with drives, at the initial speeds");
  v.maybe(x.energy_shares.has_value(), "mode_energies",
          mode_energies(x.energy_shares.value_or(coupling::EnergyShares())), "",
          "shares of the energies of each coupled mode");
  for (const auto &answer : x.answers)
    answer->describe(v);
  part("size", x.size, "`size`");
  part("story", x.story, "event log of a run");
  part("stress", x.stress, "`[output.stress]`");
  part("main_peak", x.peak, "larger extreme of the first signal in N, or else of the first signal");
  v("signals", by_name(run.signals, &coupling::SignalSummary::name), "", "extremes of each signal");
  v("events", run.events, "", "in the order of time");
  v("method", run.method, "", "method of integration with its parameters");
  v("accuracy", run.accuracy, "", "accuracy of the fixed step for each mode; empty with a controlled step");
  v("work", run.work, "", "of the integration");
  v("wall_s", x.wall_s, "s", "wall time by phase; `program`: CPU time until the scene is read");
  v("energy", keeps_energy ? std::optional(run.energy) : std::nullopt, "", "energy balance; null: not computed");
  v("warnings", all_warnings(x), "", "texts of all findings");
  v("findings", all_findings(x), "", "warnings, and the reason for an early stop");
  v("units", std::vector<std::pair<std::string, std::string>>(), "",
    "unit of each member whose unit is the same in all results, by the path of the member; others have a member "
    "`unit` of their own");
}

} // namespace gestell::apps

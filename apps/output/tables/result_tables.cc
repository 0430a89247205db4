#include "apps/output/tables/result_tables.h"

#include "apps/output/tables/budget_table.h"
#include "apps/output/tables/comparison_table.h"
#include "apps/output/tables/energy_table.h"
#include "apps/output/tables/modes_along_table.h"
#include "apps/output/tables/periodic_tables.h"
#include "apps/output/tables/sensitivity_table.h"
#include "apps/output/tables/size_table.h"
#include "apps/output/tables/stage_table.h"
#include "apps/output/tables/story_table.h"
#include "apps/output/text/csv.h"
#include "apps/output/text/json.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

Json numbers(const double *x, int n)
{
  return std::vector<double>(x, x + n);
}

Json text_or_null(const std::string &text)
{
  return text.empty() ? Json() : Json(text);
}

/// Of a number that is 0 where nothing was asked for.
Json number_or_null(double x)
{
  return x == 0. ? Json() : Json(x);
}

void add_frame(Json &json, const ModelFacts &model)
{
  if (const fem::MassProperties &whole = model.frame.whole; whole.mass > 0.)
  {
    json["centre"]  = numbers(whole.centre.data(), 3);
    json["inertia"] = Json::array();
    for (int i = 0; i < 3; ++i)
      json["inertia"].push_back(numbers(whole.inertia.data() + 3 * i, 3)); // symmetric: a column is a row
    json["parts"] = Json::array();
    for (const auto &[name, material, mass] : model.frame.parts)
      json["parts"].push_back({{"name", name}, {"material", material}, {"mass", mass}});
    json["rigid_energy"] = model.frame.rigid_energy;
  }
  if (model.damping.empty())
    return;
  json["free_motions"]      = model.free_motions;
  json["free_motion_names"] = model.frame.free_motions;
  json["damping"]           = model.damping;
  if (!model.mesh.empty())
    json["mesh"] = model.mesh;
  json["statements"] = model.statements;
}

Json model_json(const ModelFacts &model)
{
  Json       json  = Json::object();
  const auto count = [&](const char *name, int n)
  {
    if (n >= 0)
      json[name] = n;
  };
  count("dofs", model.dofs);
  count("interface", model.interface);
  count("modes", model.modes);
  count("nonlinear", model.nonlinear);
  count("frame_dofs", model.frame_dofs);
  count("cells", model.cells);
  json["frame_mass"]      = model.frame_mass;
  json["frequency_error"] = model.frequency_error;
  json["static_residual"] = model.static_residual;
  if (!std::isnan(model.frequency_limit))
    json["frequency_limit_hz"] = model.frequency_limit;
  add_frame(json, model);
  return json;
}

Json request_json(const Request &asked)
{
  Json json = {{"file", asked.file}, {"set", asked.set}};
  if (asked.run)
    json.update({{"method", coupling::method_name(asked.run->method)},
                 {"tolerance", number_or_null(asked.run->method.tolerance)},
                 {"step", number_or_null(asked.run->method.step)},
                 {"begin", asked.run->begin},
                 {"end", asked.run->end},
                 {"from", std::max(asked.run->from, asked.run->begin)},
                 {"events", asked.run->events}});
  return json;
}

/// How a run went.
Json outcome_json(const coupling::RunResult &run, const Request &asked)
{
  const std::size_t width = run.columns.size(), last_row = run.rows.size() - width;
  const bool        rows  = width > 0 && run.rows.size() >= width;
  const double      begin = asked.run ? asked.run->begin : 0.;
  return {{"method", run.method},
          {"begin", rows ? run.rows.front() : begin},
          {"end", rows ? run.rows[last_row] : begin},
          {"events_located", run.events.size()},
          {"complete", run.failure.empty() && !run.interrupted},
          {"interrupted", run.interrupted},
          {"failure", text_or_null(run.failure)}};
}

/// An array of what `of` makes of each item.
template <typename Items, typename Of>
Json array_of(const Items &items, const Of &of)
{
  Json array = Json::array();
  for (const auto &item : items)
    array.push_back(of(item));
  return array;
}

Json frequencies_json(const std::vector<coupling::Mode> &modes,
                      double coupling::Mode::*frequency = &coupling::Mode::frequency_hz)
{
  return array_of(modes, [&](const coupling::Mode &mode) { return mode.*frequency; });
}

Json signals_json(const std::vector<coupling::SignalSummary> &signals)
{
  Json json = Json::object();
  for (const coupling::SignalSummary &signal : signals)
    json[signal.name] = {{"unit", signal.unit}, {"min", signal.min},     {"t_min", signal.t_min},
                         {"max", signal.max},   {"t_max", signal.t_max}, {"final", signal.final}};
  return json;
}

Json event_json(const coupling::Event &event)
{
  return {{"t", event.t}, {"name", event.name}, {"kind", event.kind}};
}

Json work_json(const coupling::WorkCounts &work)
{
  return {{"steps", work.steps},    {"rejected", work.rejected},
          {"newton", work.newton},  {"factorisations", work.factorisations},
          {"solves", work.solves},  {"evaluations", work.evaluations},
          {"chatter", work.chatter}};
}

Json accuracy_json(const coupling::ModeAccuracy &mode)
{
  return {{"modes_of", mode.origin == coupling::ModeOrigin::base ? "base" : "closed"},
          {"number", mode.number},
          {"frequency_hz", mode.mode.omega / (2. * M_PI)},
          {"damping_ratio", mode.mode.zeta},
          {"omega_h", mode.omega_h},
          {"spectral_radius", mode.spectral_radius},
          {"numerical_damping", mode.numerical_damping},
          {"period_error", mode.period_error},
          {"unstable", mode.unstable}};
}

/// Null where no balance was kept.
Json energy_json(const coupling::RunResult &run)
{
  const coupling::EnergySummary &energy     = run.energy;
  const bool                     has_column = std::count(run.columns.begin(), run.columns.end(), "energy input") > 0;
  if (!has_column && !(energy.exchanged > 0.) && !(energy.residual > 0.))
    return nullptr;
  return {{"input", energy.input},
          {"stored", energy.stored},
          {"dissipated", energy.dissipated},
          {"residual", energy.residual},
          {"exchanged", energy.exchanged}};
}

Json pole_json(const coupling::Pole &pole)
{
  return {{"real", pole.s.real()},
          {"imaginary", pole.s.imag()},
          {"frequency_hz", pole.frequency_hz()},
          {"damping_ratio", pole.damping_ratio()},
          {"moves_most", pole.moves}};
}

Json line_json(const coupling::ModesAlong &modes, std::size_t i)
{
  const LineExtremes own = line_extremes(modes, i);
  return {{"min_hz", own.min},
          {"at_min", own.x_min},
          {"max_hz", own.max},
          {"at_max", own.x_max},
          {"least_mac", own.least_assurance},
          {"moves_most", modes.moves_most[i]},
          {"free", bool(modes.free[i])}};
}

Json meeting_json(const coupling::OrderMeeting &meeting)
{
  return {{"order", meeting.order}, {"line", meeting.line + 1}, {"from", meeting.begin},
          {"to", meeting.end},      {"nearest_at", meeting.x},  {"frequency_hz", meeting.frequency_hz}};
}

Json along_json(const AlongResult &along)
{
  Json lines = Json::array();
  for (std::size_t i = 0; i < along.modes.free.size(); ++i)
    lines.push_back(line_json(along.modes, i));
  return {{"coordinate", along.modes.coordinate.name},
          {"unit", along.modes.coordinate.unit},
          {"positions", along.modes.positions.size()},
          {"linearisations", along.modes.linearisations},
          {"geometric", along.geometric == coupling::GeometricStiffness::included},
          {"speed", along.speed},
          {"lines", lines},
          {"order_meetings", array_of(along.meetings, meeting_json)}};
}

/// Infinite amplitudes, of undamped modes, are null.
Json peak_json(const coupling::ResponsePeak &peak)
{
  return {{"frequency_hz", peak.frequency_hz},
          {"amplitude", std::isfinite(peak.amplitude) ? Json(peak.amplitude) : Json()},
          {"damping_ratio", std::isfinite(peak.damping_ratio) ? Json(peak.damping_ratio) : Json()}};
}

Json frf_json(const FrequencyResponse &response)
{
  const auto pair_json = [](const ResponsePair &pair)
  {
    return Json{{"name", pair.name()},
                {"from", pair.from},
                {"to", pair.to},
                {"unit", pair.unit},
                {"peaks", array_of(pair.peaks, peak_json)}};
  };
  const auto measured_json = [&](const MeasuredResponse &curve)
  {
    return Json{{"file", curve.file},
                {"name", curve.name},
                {"pair", response.pairs[curve.pair].name()},
                {"points", curve.values.size()}};
  };
  return {{"kind", response.kind},
          {"at", response.at},
          {"t", response.t},
          {"moves", response.moves},
          {"closed_contacts", response.closed_contacts},
          {"open_contacts", response.open_contacts},
          {"points", response.frequencies_hz.size()},
          {"pairs", array_of(response.pairs, pair_json)},
          {"measured", array_of(response.measured, measured_json)}};
}

Json stress_place_json(const StressPlace &place)
{
  return {{"von_mises", place.von_mises},
          {"at", numbers(place.at.data(), 3)},
          {"principal", numbers(place.principal.values.data(), 3)},
          {"first_direction", numbers(place.principal.first.data(), 3)},
          {"disagreement", place.disagreement},
          {"beside", place.beside}};
}

Json stress_at_json(const StressAt &at)
{
  Json json = {{"label", at.label}, {"t", at.t}};
  if (at.peak)
    json["largest"] = stress_place_json(*at.peak);
  if (at.beside_rigid)
    json["beside_rigid"] = stress_place_json(*at.beside_rigid);
  return json;
}

Json stress_json(const StressResult &stress)
{
  return {{"points", stress.points.size()},
          {"states", stress.n_states},
          {"step", stress.step},
          {"instants", array_of(stress.instants, stress_at_json)}};
}

void append_modes(std::string &csv, const std::vector<coupling::Mode> &modes, const char *kind)
{
  int number = 0;
  for (const coupling::Mode &mode : modes)
  {
    csv += std::to_string(++number);
    for (const double x : {mode.frequency_hz, mode.damped_frequency_hz, mode.damping_ratio, mode.effective_mass[0],
                           mode.effective_mass[1], mode.effective_mass[2]})
      append_exact(csv += ',', x);
    csv += std::string(",") + kind + ',';
    append_exact(csv, mode.growth);
    append_exact(csv += ',', mode.refined_hz);
    csv += '\n';
  }
}

} // namespace

std::vector<std::string> all_warnings(const Result &result)
{
  std::vector<std::string> warnings;
  const auto               add = [&](const std::string &warning)
  {
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end())
      warnings.push_back(warning);
  };
  if (result.run && !result.run->failure.empty())
    add("The computation stopped early: " + result.run->failure);
  if (result.run && result.run->interrupted)
    add("The computation was interrupted; the results end where it stopped.");
  for (const std::string &warning : result.warnings)
    add(warning);
  if (result.run)
    for (const std::string &warning : result.run->warnings)
      add(warning);
  return warnings;
}

std::string summary_json(const Result &result)
{
  // A result without a run has no signals, but all members, so that readers need not ask.
  const coupling::RunResult run = result.run.value_or(coupling::RunResult());

  Json json = {{"scene", result.scene},
               {"version", result.version},
               {"commit", text_or_null(result.commit)},
               {"command", result.command},
               {"asked", request_json(result.asked)}};
  if (result.run)
    json["outcome"] = outcome_json(*result.run, result.asked);
  json["model"]           = model_json(result.model);
  json["bodies_from_cad"] = result.bodies_from_cad;
  json["frequencies_hz"]  = frequencies_json(result.coupled_modes.empty() ? result.frame_modes : result.coupled_modes);
  json["frame_frequencies_hz"]         = frequencies_json(result.frame_modes);
  json["frame_refined_frequencies_hz"] = frequencies_json(result.frame_modes, &coupling::Mode::refined_hz);
  json["operating_poles"]              = array_of(result.poles, pole_json);
  if (result.energy_shares)
    json["mode_energies"] = mode_energies_json(*result.energy_shares);
  if (result.compared_shapes)
    json["compared_modes"] = compared_modes_json(*result.compared_shapes);
  if (result.run && result.compared_run)
    json["compared_run"] = compared_run_json(*result.run, *result.compared_run);
  if (result.along)
    json["modes_along"] = along_json(*result.along);
  if (result.periodic)
    json["periodic"] = periodic_json(*result.periodic);
  if (result.frf)
    json["frf"] = frf_json(*result.frf);
  if (result.budget)
  {
    json["budget"]       = budget_json(*result.budget);
    json["budget_cpu_s"] = budget_cost_json(*result.budget);
  }
  if (result.sensitivities)
    json["sensitivities"] = sensitivities_json(*result.sensitivities);
  if (result.size)
    json["size"] = size_json(*result.size);
  if (result.stages)
  {
    json["stages"]   = stages_json(*result.stages);
    json["lift_off"] = lift_off_json(*result.stages);
    json["ringing"]  = ringing_json(*result.stages);
  }
  if (result.story)
    json["story"] = story_json(*result.story);
  if (result.stress)
    json["stress"] = stress_json(*result.stress);
  if (result.peak)
    json["main_peak"] = {{"signal", result.peak->signal},
                         {"value", result.peak->value},
                         {"t", result.peak->t},
                         {"half_swing", result.peak->half_swing > 0. ? Json(result.peak->half_swing) : Json()}};
  json["signals"]  = signals_json(run.signals);
  json["events"]   = array_of(run.events, event_json);
  json["method"]   = run.method;
  json["accuracy"] = array_of(run.accuracy, accuracy_json);
  json["work"]     = work_json(run.work);
  json["wall_s"]   = Json::object();
  for (const auto &[phase, seconds] : result.wall_s)
    json["wall_s"][phase] = seconds;
  json["energy"]   = energy_json(run);
  json["warnings"] = all_warnings(result);
  return json_text(json);
}

std::string history_csv(const coupling::RunResult &run)
{
  const std::size_t width = run.columns.size();
  std::string       csv;
  csv.reserve(20 * (run.rows.size() + width));
  for (std::size_t j = 0; j < width; ++j)
    csv += (j > 0 ? "," : "") + csv_field(run.columns[j] + " [" + run.units[j] + "]");
  csv += '\n';
  for (std::size_t i = 0; i + width <= run.rows.size(); i += width)
  {
    for (std::size_t j = 0; j < width; ++j)
    {
      if (j > 0)
        csv += ',';
      append_exact(csv, run.rows[i + j]);
    }
    csv += '\n';
  }
  return csv;
}

std::string modes_csv(const Result &result)
{
  std::string csv =
      "mode,frequency [Hz],damped frequency [Hz],damping ratio,"
      "effective mass x [kg],effective mass y [kg],effective mass z [kg],kind,growth [1/s],refined frequency [Hz]\n";
  append_modes(csv, result.frame_modes, "frame");
  append_modes(csv, result.coupled_modes, "coupled");
  return csv;
}

} // namespace gestell::apps

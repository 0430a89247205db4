#include "apps/output/tables/result_tables.h"

#include "apps/output/tables/modes_along_table.h"
#include "apps/output/text/json.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

/// A field of a CSV row (RFC 4180): quoted where it holds a separator, a quote or a line end.
std::string csv_field(const std::string &text)
{
  if (text.find_first_of(",\"\r\n") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

void write_numbers(JsonWriter &json, const char *name, const double *x, int n)
{
  json.begin_array(name);
  for (int i = 0; i < n; ++i)
    json.number("", x[i]);
  json.end_array();
}

void write_frame(JsonWriter &json, const ModelFacts &model)
{
  if (const fem::MassProperties &whole = model.frame.whole; whole.mass > 0.)
  {
    write_numbers(json, "centre", whole.centre.data(), 3);
    json.begin_array("inertia");
    for (int i = 0; i < 3; ++i)
      write_numbers(json, "", whole.inertia.data() + 3 * i, 3); // symmetric: a column is a row
    json.end_array();
    json.begin_array("parts");
    for (const auto &[name, material, mass] : model.frame.parts)
    {
      json.begin_object();
      json.text("name", name);
      json.text("material", material);
      json.number("mass", mass);
      json.end_object();
    }
    json.end_array();
    json.number("rigid_energy", model.frame.rigid_energy);
  }
  if (model.damping.empty())
    return;
  json.integer("free_motions", model.free_motions);
  json.begin_array("free_motion_names");
  for (const std::string &name : model.frame.free_motions)
    json.text("", name);
  json.end_array();
  json.text("damping", model.damping);
  if (!model.mesh.empty())
    json.text("mesh", model.mesh);
  json.begin_array("statements");
  for (const std::string &statement : model.statements)
    json.text("", statement);
  json.end_array();
}

void write_model(JsonWriter &json, const ModelFacts &model)
{
  const auto count = [&](const char *name, int n)
  {
    if (n >= 0)
      json.integer(name, n);
  };
  json.begin_object("model");
  count("dofs", model.dofs);
  count("interface", model.interface);
  count("modes", model.modes);
  count("nonlinear", model.nonlinear);
  count("frame_dofs", model.frame_dofs);
  count("cells", model.cells);
  json.number("frame_mass", model.frame_mass);
  json.number("frequency_error", model.frequency_error);
  json.number("static_residual", model.static_residual);
  if (!std::isnan(model.frequency_limit))
    json.number("frequency_limit_hz", model.frequency_limit);
  write_frame(json, model);
  json.end_object();
}

void text_or_null(JsonWriter &json, const std::string &name, const std::string &text)
{
  if (text.empty())
    json.null(name);
  else
    json.text(name, text);
}

/// Of numbers that are 0 where nothing was asked for.
void number_or_null(JsonWriter &json, const std::string &name, double x)
{
  if (x == 0.)
    json.null(name);
  else
    json.number(name, x);
}

void write_request(JsonWriter &json, const Request &asked)
{
  json.begin_object("asked");
  json.text("file", asked.file);
  json.begin_array("set");
  for (const std::string &entry : asked.set)
    json.text("", entry);
  json.end_array();
  if (asked.run)
  {
    const coupling::MethodOptions &method = asked.run->method;
    json.text("method", coupling::method_name(method));
    number_or_null(json, "tolerance", method.tolerance);
    number_or_null(json, "step", method.step);
    json.number("begin", asked.run->begin);
    json.number("end", asked.run->end);
    json.boolean("events", asked.run->events);
  }
  json.end_object();
}

/// How a run went.
void write_outcome(JsonWriter &json, const coupling::RunResult &run, const Request &asked)
{
  const std::size_t width = run.columns.size(), last_row = run.rows.size() - width;
  const bool        rows = width > 0 && run.rows.size() >= width;
  json.begin_object("outcome");
  json.text("method", run.method);
  json.number("begin", rows ? run.rows.front() : asked.run ? asked.run->begin : 0.);
  json.number("end", rows ? run.rows[last_row] : asked.run ? asked.run->begin : 0.);
  json.integer("events_located", static_cast<long long>(run.events.size()));
  json.boolean("complete", run.failure.empty() && !run.interrupted);
  json.boolean("interrupted", run.interrupted);
  text_or_null(json, "failure", run.failure);
  json.end_object();
}

void write_frequencies(JsonWriter &json, const std::string &name, const std::vector<coupling::Mode> &modes,
                       double coupling::Mode::*frequency = &coupling::Mode::frequency_hz)
{
  json.begin_array(name);
  for (const coupling::Mode &mode : modes)
    json.number("", mode.*frequency);
  json.end_array();
}

void write_signals(JsonWriter &json, const std::vector<coupling::SignalSummary> &signals)
{
  json.begin_object("signals");
  for (const coupling::SignalSummary &signal : signals)
  {
    json.begin_object(signal.name);
    json.text("unit", signal.unit);
    json.number("min", signal.min);
    json.number("t_min", signal.t_min);
    json.number("max", signal.max);
    json.number("t_max", signal.t_max);
    json.number("final", signal.final);
    json.end_object();
  }
  json.end_object();
}

void write_events(JsonWriter &json, const std::vector<coupling::Event> &events)
{
  json.begin_array("events");
  for (const coupling::Event &event : events)
  {
    json.begin_object();
    json.number("t", event.t);
    json.text("name", event.name);
    json.text("kind", event.kind);
    json.end_object();
  }
  json.end_array();
}

void write_work(JsonWriter &json, const coupling::WorkCounts &work)
{
  json.begin_object("work");
  json.integer("steps", work.steps);
  json.integer("rejected", work.rejected);
  json.integer("newton", work.newton);
  json.integer("factorisations", work.factorisations);
  json.integer("solves", work.solves);
  json.integer("evaluations", work.evaluations);
  json.integer("chatter", work.chatter);
  json.end_object();
}

void write_accuracy(JsonWriter &json, const std::vector<coupling::ModeAccuracy> &modes)
{
  json.begin_array("accuracy");
  for (const coupling::ModeAccuracy &mode : modes)
  {
    json.begin_object();
    json.text("modes_of", mode.origin == coupling::ModeOrigin::base ? "base" : "closed");
    json.integer("number", mode.number);
    json.number("frequency_hz", mode.mode.omega / (2. * M_PI));
    json.number("damping_ratio", mode.mode.zeta);
    json.number("omega_h", mode.omega_h);
    json.number("spectral_radius", mode.spectral_radius);
    json.number("numerical_damping", mode.numerical_damping);
    json.number("period_error", mode.period_error);
    json.boolean("unstable", mode.unstable);
    json.end_object();
  }
  json.end_array();
}

void write_energy(JsonWriter &json, const coupling::EnergySummary &energy)
{
  json.begin_object("energy");
  json.number("input", energy.input);
  json.number("stored", energy.stored);
  json.number("dissipated", energy.dissipated);
  json.number("residual", energy.residual);
  json.number("exchanged", energy.exchanged);
  json.end_object();
}

void write_poles(JsonWriter &json, const std::vector<coupling::Pole> &poles)
{
  json.begin_array("operating_poles");
  for (const coupling::Pole &pole : poles)
  {
    json.begin_object();
    json.number("real", pole.s.real());
    json.number("imaginary", pole.s.imag());
    json.number("frequency_hz", pole.frequency_hz());
    json.number("damping_ratio", pole.damping_ratio());
    json.text("moves_most", pole.moves);
    json.end_object();
  }
  json.end_array();
}

void write_along(JsonWriter &json, const AlongResult &along)
{
  json.begin_object("modes_along");
  json.text("coordinate", along.modes.coordinate.name);
  json.text("unit", along.modes.coordinate.unit);
  json.integer("positions", static_cast<long long>(along.modes.positions.size()));
  json.integer("linearisations", along.modes.linearisations);
  json.boolean("geometric", along.geometric == coupling::GeometricStiffness::included);
  json.number("speed", along.speed);
  json.begin_array("lines");
  for (std::size_t i = 0; i < along.modes.free.size(); ++i)
  {
    const LineExtremes own = line_extremes(along.modes, i);
    json.begin_object();
    json.number("min_hz", own.min);
    json.number("at_min", own.x_min);
    json.number("max_hz", own.max);
    json.number("at_max", own.x_max);
    json.number("least_mac", own.least_assurance);
    json.text("moves_most", along.modes.moves_most[i]);
    json.boolean("free", along.modes.free[i]);
    json.end_object();
  }
  json.end_array();
  json.begin_array("order_meetings");
  for (const coupling::OrderMeeting &meeting : along.meetings)
  {
    json.begin_object();
    json.integer("order", meeting.order);
    json.integer("line", meeting.line + 1);
    json.number("from", meeting.begin);
    json.number("to", meeting.end);
    json.number("nearest_at", meeting.x);
    json.number("frequency_hz", meeting.frequency_hz);
    json.end_object();
  }
  json.end_array();
  json.end_object();
}

void write_stress_place(JsonWriter &json, const std::string &name, const StressPlace &place)
{
  const auto three = [&](const char *member, const Eigen::Vector3d &x)
  {
    json.begin_array(member);
    for (const double value : x)
      json.number("", value);
    json.end_array();
  };
  json.begin_object(name);
  json.number("von_mises", place.von_mises);
  three("at", place.at);
  three("principal", place.principal.values);
  three("first_direction", place.principal.first);
  json.number("disagreement", place.disagreement);
  json.text("beside", place.beside);
  json.end_object();
}

void write_stress(JsonWriter &json, const StressResult &stress)
{
  json.begin_object("stress");
  json.integer("points", static_cast<long long>(stress.points.size()));
  json.integer("states", stress.n_states);
  json.number("step", stress.step);
  json.begin_array("instants");
  for (const StressAt &at : stress.instants)
  {
    json.begin_object();
    json.text("label", at.label);
    json.number("t", at.t);
    if (at.peak)
      write_stress_place(json, "largest", *at.peak);
    if (at.beside_rigid)
      write_stress_place(json, "beside_rigid", *at.beside_rigid);
    json.end_object();
  }
  json.end_array();
  json.end_object();
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

  JsonWriter json;
  json.begin_object();
  json.text("scene", result.scene);
  json.text("version", result.version);
  text_or_null(json, "commit", result.commit);
  json.text("command", result.command);
  write_request(json, result.asked);
  if (result.run)
    write_outcome(json, *result.run, result.asked);
  write_model(json, result.model);
  json.begin_array("bodies_from_cad");
  for (const std::string &body : result.bodies_from_cad)
    json.text("", body);
  json.end_array();
  write_frequencies(json, "frequencies_hz", result.coupled_modes.empty() ? result.frame_modes : result.coupled_modes);
  write_frequencies(json, "frame_frequencies_hz", result.frame_modes);
  write_frequencies(json, "frame_refined_frequencies_hz", result.frame_modes, &coupling::Mode::refined_hz);
  write_poles(json, result.poles);
  if (result.along)
    write_along(json, *result.along);
  if (result.stress)
    write_stress(json, *result.stress);
  write_signals(json, run.signals);
  write_events(json, run.events);
  json.text("method", run.method);
  write_accuracy(json, run.accuracy);
  write_work(json, run.work);
  json.begin_object("wall_s");
  for (const auto &[phase, seconds] : result.wall_s)
    json.number(phase, seconds);
  json.end_object();
  write_energy(json, run.energy);
  json.begin_array("warnings");
  for (const std::string &warning : all_warnings(result))
    json.text("", warning);
  json.end_array();
  json.end_object();
  return json.document();
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

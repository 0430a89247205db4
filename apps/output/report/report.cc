#include "apps/output/report/report.h"
#include "apps/output/describe/described_table.h"

#include "apps/output/charts/mode_charts.h"
#include "apps/output/charts/signal_charts.h"
#include "apps/output/interactive/live_chart.h"
#include "apps/output/interactive/machine_view.h"
#include "apps/output/interactive/page_scripts.h"
#include "apps/output/report/frame_text.h"
#include "apps/output/report/machine_report.h"
#include "apps/output/report/overview_report.h"
#include "apps/output/report/section.h"
#include "apps/output/report/story_report.h"
#include "apps/output/report/stress_report.h"
#include "apps/output/tables/mode_tables.h"
#include "apps/output/tables/noise.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "apps/output/values/coupling_descriptions.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

/// A table of two columns for facts; those without a value are left out.
class Facts
{
public:
  void add(const std::string &name, const std::string &value)
  {
    rows_ += "<tr><th>" + name + "</th><td class=\"n\">" + value + "</td></tr>\n";
  }
  void count(const std::string &name, long n)
  {
    if (n >= 0)
      add(name, std::to_string(n));
  }
  void quantity(const std::string &name, double x, const std::string &unit)
  {
    if (!std::isnan(x))
      add(name, short_text(x) + (unit.empty() ? "" : " " + unit));
  }
  std::string table() const { return rows_.empty() ? "" : "<div class=\"wide\"><table>" + rows_ + "</table></div>\n"; }

private:
  std::string rows_;
};

std::string peaks_table(const Result &result)
{
  if (!result.run || result.run->signals.empty())
    return "";
  HtmlTable   table({"signal", "unit", "#maximum", "#time [s]", "#minimum", "#time [s]", "#final value"});
  const Noise noise = noise_of(result.run->signals);
  for (const coupling::SignalSummary &signal : result.run->signals)
  {
    const DisplayUnit shown = display_unit(signal.unit, std::max(std::abs(signal.min), std::abs(signal.max)));
    const auto        value = [&](double x) { return short_text(noise.without(signal.unit, x) * shown.factor, 5); };
    table.add({signal.name, shown.unit, peak(value(signal.max)), short_text(signal.t_max, 6), peak(value(signal.min)),
               short_text(signal.t_min, 6), value(signal.final)});
    if (signal.unit == "rad/s") // as drives are named
    {
      const auto turns = [&](double x) { return short_text(noise.without(signal.unit, x) * 60. / two_pi, 5); };
      table.add({"", "1/min", peak(turns(signal.max)), "", peak(turns(signal.min)), "", turns(signal.final)});
    }
  }
  return table.html();
}

std::string window_sentence(const Result &result)
{
  if (!result.run || result.run->rows.empty() || !(result.run->from > result.run->rows.front()))
    return "";
  return "<p>Extremes are evaluated from " + short_text(result.run->from, 6) + " s ([output] from).</p>\n";
}

std::string answer_section(const Result &result, bool has_view)
{
  const std::string table = peaks_table(result), picture = has_view ? machine_figure(result) + peak_figure(result) : "";
  if (table.empty() && picture.empty())
    return "";
  return section("peaks", table.empty() ? "Machine" : "Peak values and their times",
                 window_sentence(result) + "<div class=\"row\">" + table + picture + "</div>\n");
}

std::string signal_figure(const SignalChart &chart)
{
  return live_figure(chart.chart, chart.svg, chart.is_part ? ChartLink::cursor : ChartLink::time);
}

std::string chart_section(const std::vector<SignalChart> &charts, ChartTopic topic, const std::string &id,
                          const std::string &title, Shown shown = Shown::open)
{
  std::vector<std::string> figures;
  for (const SignalChart &chart : charts)
    if (chart.topic == topic)
      figures.push_back(signal_figure(chart));
  return section(id, title, first_figures(figures), shown);
}

std::string events_section(const Result &result)
{
  if (!result.run || result.run->events.empty())
    return "";
  HtmlTable table({"#no.", "#time [s]", "object", "event"});
  int       number = 0;
  for (const coupling::Event &event : result.run->events)
    table.add({std::to_string(++number), short_text(event.t, 7), event.name, event.kind});
  return section("events", "Events",
                 "<p class=\"soft\">The numbers are those above the charts. Short ticks mark closely spaced "
                 "events.</p><div class=\"long\">" +
                     table.scrolled_html() + "</div>\n",
                 Shown::folded);
}

/// Meaning and limits of the residual of the energy balance.
std::string energy_statement(const coupling::EnergySummary &energy, bool has_frame)
{
  return "<p class=\"lead\">The energy residual |input − stored − dissipated| is at most "
         "<strong>" +
         short_text(energy.residual, 3) + " J</strong>" +
         (energy.exchanged > 0.
              ? ", <strong>" + short_text(100. * energy.residual / energy.exchanged, 2) + " %</strong> of the " +
                    short_text(energy.exchanged, 3) + " J exchanged by the motion"
              : "") +
         ".</p><p>It measures the error of the time integration only." +
         (has_frame ? " It does not contain the errors of mesh and reduction." : "") + "</p>\n";
}

std::string energy_section(const Result &result, const std::vector<SignalChart> &charts)
{
  if (!result.run)
    return "";
  const coupling::EnergySummary &energy = result.run->energy;
  if (energy.input == 0. && energy.stored == 0. && energy.dissipated == 0. && energy.residual == 0.)
    return "";
  Facts facts;
  facts.quantity("energy input by drives", energy.input, "J");
  facts.quantity("change of stored energy", energy.stored, "J");
  facts.quantity("dissipated energy, including work of tools", energy.dissipated, "J");
  facts.quantity("energy exchanged by the motion", energy.exchanged, "J");
  facts.quantity("largest energy residual", energy.residual, "J");
  std::string html = energy_statement(energy, result.scenery.n_frame > 0) + facts.table();
  for (const SignalChart &chart : charts)
    if (chart.topic == ChartTopic::energy)
      html += signal_figure(chart);
  return section("energy", "Energy balance", html, Shown::folded);
}

/// Marks the frequencies above the limit of a reduced frame.
/// @param limit  [Hz]; nan: none
std::string mode_table(const std::vector<coupling::Mode> &modes, double limit)
{
  const bool growing = std::any_of(modes.begin(), modes.end(), [](const auto &mode) { return mode.growth > 0.; });
  const bool refined = any_refined(modes);
  std::vector<std::string> columns = {"#mode",          "#frequency [Hz]",        "#damped frequency [Hz]",
                                      "#damping ratio", "#effective mass x [kg]", "#y [kg]",
                                      "#z [kg]"};
  if (growing)
    columns.insert(columns.begin() + 4, "#growth");
  if (refined)
    columns.insert(columns.begin() + 2, "#refined frequency [Hz]");
  HtmlTable table(columns);
  Noise     noise;
  for (const coupling::Mode &mode : modes)
    for (const double mass : mode.effective_mass)
      noise.see("kg", mass);
  const auto mass_text = [&](double mass) { return short_text(noise.without("kg", mass)); };
  int        number    = 0;
  for (const coupling::Mode &mode : modes)
  {
    if (const std::string above =
            words_above(limit, number > 0 ? modes[number - 1].frequency_hz : 0., mode.frequency_hz);
        !above.empty())
      table.add_note(above);
    const auto &[x, y, z]            = mode.effective_mass;
    std::vector<HtmlTable::Cell> row = {std::to_string(++number),
                                        short_text(mode.frequency_hz, 6),
                                        short_text(mode.damped_frequency_hz, 6),
                                        short_text(mode.damping_ratio),
                                        mass_text(x),
                                        mass_text(y),
                                        mass_text(z)};
    if (growing)
      row.insert(row.begin() + 4, mode.growth > 0. ? "exp(" + short_text(mode.growth) + " t/s)" : "–");
    if (refined)
      row.insert(row.begin() + 2, short_text(mode.refined_hz, 6));
    table.add(row);
  }
  return table.html() + (refined ? "<p>" + std::string(refined_words) + "</p>\n" : "");
}

/// Table of the energy of each mode by parts.
std::string energy_shares_table(const Result &result)
{
  if (!result.energy_shares)
    return "";
  HtmlTable table({"#mode", "#frequency [Hz]", "strain energy by part", "kinetic energy by part"});
  for (std::size_t j = 0; j < result.coupled_modes.size(); ++j)
    table.add({std::to_string(j + 1), short_text(result.coupled_modes[j].frequency_hz, 6),
               strain_text(*result.energy_shares, j), kinetic_text(*result.energy_shares, j)});
  return table.html();
}

std::string pole_table(const std::vector<coupling::Pole> &poles)
{
  HtmlTable table({"#damped frequency [Hz]", "#damping ratio", "#growth or decay", "dominant DOF"});
  for (const coupling::Pole &pole : poles)
    table.add({pole.vibrates() ? short_text(pole.frequency_hz(), 6) : "–",
               pole.vibrates() ? short_text(pole.damping_ratio()) : "–",
               peak("exp(" + short_text(pole.s.real()) + " t/s)", pole.s.real() > 0.), pole.moves});
  return "<h3>Poles with drives and controllers, at the initial speeds</h3>" + table.html();
}

std::string modes_section(const Result &result, bool has_view, Pictures &pictures)
{
  constexpr std::size_t most_mode_pictures = 9, most_coupled_pictures = 6; // rows of three on paper
  const auto bars = [&](const std::vector<coupling::Mode> &modes, const std::string &name, const std::string &words)
  {
    std::string html;
    for (std::size_t j = 0; j < std::min(modes.size(), most_mode_pictures); ++j)
    {
      pictures.emplace_back("mode-" + name + "-" + std::to_string(j + 1),
                            shape_svg(result, words + mode_heading(j, modes[j]), modes[j]));
      html += figure(pictures.back().second);
    }
    return html.empty() ? "" : folded("Mode shapes by DOF", "<div class=\"bars\">" + html + "</div>\n");
  };
  std::string html;
  if (!result.coupled_modes.empty())
    html += "<h3>Coupled machine</h3>" + mode_table(result.coupled_modes, result.model.frequency_limit) +
            energy_shares_table(result) +
            (has_view ? mode_pictures(result.coupled_modes, "coupled", most_coupled_pictures) : "") +
            bars(result.coupled_modes, "coupled", "");
  if (!result.poles.empty())
    html += pole_table(result.poles);
  if (!result.frame_modes.empty())
    html += "<h3>Supported frame alone</h3>" + mode_table(result.frame_modes, result.model.frequency_limit) +
            (!result.scenery.has_skin() ? bars(result.frame_modes, "frame", "Frame ")
             : has_view                 ? mode_pictures(result.frame_modes, "frame", most_mode_pictures)
                                        : "");
  const bool asked = !result.run && result.answers.empty();
  return section("modes", "Natural frequencies and mode shapes", html, asked ? Shown::open : Shown::folded);
}

/// Numerical damping and period error of each mode, the lowest first; modes above only follow the drives.
std::string accuracy_table(const coupling::RunResult &run)
{
  if (run.accuracy.empty())
    return "";
  std::vector<coupling::ModeAccuracy> shown;
  constexpr std::size_t               most_accuracy_rows = 40; // a screen; the file has all
  for (const coupling::ModeAccuracy &mode : run.accuracy)
    if (shown.size() < most_accuracy_rows || mode.unstable)
      shown.push_back(mode);
  return "<h3>Numerical damping and period error of " + escape_xml(run.method) + "</h3>" + table_of(shown).html();
}

std::string numerics_section(const Result &result)
{
  const ModelFacts &m = result.model;
  Facts             model;
  model.count("DOFs of the time integration", m.dofs);
  model.count("interface DOFs", m.interface);
  model.count("retained internal modes", m.modes);
  model.count("local coordinates of nonlinear elements", m.nonlinear);
  model.count("DOFs of the unreduced frame", m.frame_dofs);
  model.count("finite elements", m.cells);
  model.quantity("mass of the frame", m.frame_mass, "kg");
  model.quantity("estimated frequency error due to reduction", 100. * m.frequency_error, "%");
  model.quantity("static load not represented by the modes", 100. * m.static_residual, "%");

  Facts work;
  if (result.run)
  {
    const coupling::WorkCounts &w = result.run->work;
    work.count("steps", w.steps);
    work.count("rejected steps", w.rejected);
    work.count("Newton iterations", w.newton);
    work.quantity("Newton iterations per step", w.steps > 0 ? static_cast<double>(w.newton) / w.steps : std::nan(""),
                  "");
    work.count("factorisations", w.factorisations);
    work.count("element evaluations", w.evaluations);
    if (w.chatter > 0)
      work.count("steps with chatter, events not located", w.chatter);
    work.quantity("wall time per step",
                  w.steps > 0 && result.run->wall_s > 0. ? 1e6 * result.run->wall_s / w.steps : std::nan(""), "µs");
  }
  for (const auto &[phase, seconds] : result.wall_s)
    work.quantity("wall time: " + escape_xml(phase), seconds, "s");

  Facts page;
  for (const PageLibrary &library : page_libraries())
    page.add("page library: " + library.name, library.version + ", " + library.source);
  std::string html = "<div class=\"row\">" + model.table() + work.table() + page.table() + "</div>";
  if (!std::isnan(m.static_residual))
    html += "<p class=\"soft\">" + escape_xml(static_residual_words) + "</p>\n";
  if (const auto lines = frame_text(m); !lines.empty())
  {
    html += "<h3>Frame</h3><ul>";
    for (const std::string &line : lines)
      html += "<li>" + escape_xml(line) + "</li>";
    html += "</ul>\n";
  }
  if (!result.bodies_from_cad.empty())
  {
    html += "<h3>Bodies from CAD</h3><ul>";
    for (const std::string &body : result.bodies_from_cad)
      html += "<li>" + escape_xml(body) + "</li>";
    html += "</ul>\n";
  }
  if (!result.settings.empty())
    html += "<h3>Settings</h3><pre>" + escape_xml(result.settings) + "</pre>\n";
  if (result.run)
    html += accuracy_table(*result.run);
  return section("numerics", "Model and computation", html, Shown::folded);
}

/// Sections in their order, those without content left out, and the links to them.
class Body
{
public:
  explicit Body(const Result &result, Pictures &pictures) : pictures_(pictures)
  {
    for (const auto &answer : result.answers)
      for (Section &own : answer->sections(result))
        answers_.push_back(std::move(own));
  }
  void add(const std::string &content, const std::string &id = "", const std::string &link = "")
  {
    html += content;
    if (!content.empty() && !link.empty())
      links += "<a href=\"#" + id + "\">" + link + "</a>";
  }
  void add(Section::Place place)
  {
    for (const Section &own : answers_)
      if (own.place == place)
        add(section_html(own, pictures_), own.id, own.link);
  }

  std::string html, links;

private:
  Pictures            &pictures_;
  std::vector<Section> answers_;
};

} // namespace

Report make_report(const Result &result)
{
  const std::string              view     = machine_view(result);
  const bool                     has_view = !view.empty();
  Report                         report;
  const std::vector<SignalChart> charts = result.run ? signal_charts(*result.run) : std::vector<SignalChart>();
  for (const SignalChart &chart : charts)
    report.charts.emplace_back(chart.name, chart.svg);

  Body body(result, report.charts);
  body.add(Section::Place::first);
  body.add(answer_section(result, has_view), "peaks", "Peaks");
  body.add(section("view", "Interactive 3-D view", view), "view", "Machine");
  body.add(Section::Place::course);
  body.add(Section::Place::results);
  body.add(stress_section(result, has_view), "stress", "Stress");
  body.add(chart_section(charts, ChartTopic::force, "forces", "Forces"), "forces", "Forces");
  body.add(chart_section(charts, ChartTopic::motion, "motion", "Motion"), "motion", "Motion");
  body.add(chart_section(charts, ChartTopic::other, "signals", "Other signals", Shown::folded));
  body.add(story_section(result), "story", "Events and modes");
  body.add(Section::Place::history);
  body.add(events_section(result), "events", "Events");
  body.add(energy_section(result, charts), "energy", "Energy");
  body.add(Section::Place::frequencies);
  body.add(modes_section(result, has_view, report.charts), "modes", "Modes");
  body.add(numerics_section(result), "numerics", "Model and computation");

  report.html = page_html(
      {result.scene, result.description,
       overview(result) + note_box(all_warnings(result), "Warnings") + "<nav>" + body.links + "</nav>\n" + body.html,
       "Computed with gestell " + escape_xml(result.version) +
           ". Full-precision values: summary.json and the .csv files next to this page." +
           (result.run && !result.run->picture_states.empty() ? " ParaView: motion.pvd." : ""),
       "",
       page_scripts(body.html.find("<figure class=\"live\"") != std::string::npos,
                    body.html.find("<div class=\"machine\"") != std::string::npos)});
  return report;
}

} // namespace gestell::apps

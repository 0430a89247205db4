#include "apps/output/report/stability_report.h"

#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr std::size_t most_rows = 40; ///< of modes in a terminal

const char *origin_text(coupling::ModeOrigin origin)
{
  return origin == coupling::ModeOrigin::base ? "frame" : "closed contacts";
}

std::string percent(double share)
{
  return std::isnan(share) ? "–" : short_text(100. * share, 3) + " %";
}

std::string verdict_of(const coupling::ModeAccuracy &mode)
{
  return mode.unstable ? "grows" : "stable";
}

std::string verdict_of(const MethodVerdict &verdict)
{
  if (verdict.growing == 0)
    return "stable";
  return verdict.only_closed ? "while contacts are closed, grows" : "unstable";
}

std::string step_text(double step)
{
  const DisplayUnit unit = step < 1e-3 ? DisplayUnit{1e6, "us"}
                           : step < 1. ? DisplayUnit{1e3, "ms"}
                                       : DisplayUnit{1., "s"};
  return short_text(step * unit.factor) + " " + unit.unit;
}

std::string modes_section(const StabilityStudy &study)
{
  if (study.modes.empty())
    return "";
  HtmlTable modes({"modes of", "#mode", "#f [Hz]", "#damping ratio", "#ω h", "#spectral radius", "#numerical damping",
                   "#period error", "#verdict"});
  for (const auto &mode : study.modes)
    modes.add({origin_text(mode.origin), std::to_string(mode.number), short_text(mode.mode.omega / two_pi, 6),
               short_text(mode.mode.zeta), short_text(mode.omega_h), short_text(mode.spectral_radius, 7),
               short_text(mode.numerical_damping, 3), percent(mode.period_error),
               peak(verdict_of(mode), mode.unstable)});
  HtmlTable others({"method", "#verdict", "#modes that grow", "#worst, f [Hz]", "#growth per step",
                    "#largest step that works", "#period error, lowest mode of the frame", "#highest mode"});
  for (const MethodVerdict &verdict : study.verdicts)
  {
    const bool grows = verdict.growing > 0;
    others.add({verdict.method, peak(verdict_of(verdict), grows), std::to_string(verdict.growing),
                grows ? short_text(verdict.worst_hz) : "–", grows ? short_text(verdict.growth, 6) : "–",
                !grows                         ? "–"
                : verdict.step_that_works > 0. ? step_text(verdict.step_that_works)
                                               : "none",
                percent(verdict.lowest_period_error), percent(verdict.highest_period_error)});
  }
  return section("modes", "The modes under " + escape_xml(study.method),
                 modes.scrolled_html() +
                     "<p class=\"soft\">Numerical damping comes beyond the physical one; a period error above zero "
                     "means too slow. Modes that do not vibrate are left out.</p><h3>Other methods at this step</h3>" +
                     others.html());
}

std::string maps_section(const StabilityStudy &study)
{
  std::string html = "<p>The oscillator x″ + 2ζω x′ + ω² x = 0 with "
                     "the step h. Above the line at 1 a mode grows.";
  if (!study.modes.empty())
    html += " Ticks at the bottom: modes of the frame (blue) and of the machine with closed contacts (orange) at the "
            "scene's step, those below omega h = 0.01 left out; under exact propagation the frame's modes have no "
            "error. What "
            "has no damping or period error of its own has no curve there.";
  html += "</p>\n";
  bool first = true;
  for (const auto &[zeta, charts] : study.charts)
  {
    html += std::string("<details") + (first ? " open" : "") + "><summary>damping ratio " + short_text(zeta) +
            "</summary>\n";
    for (const NamedSvg &chart : charts)
      html += figure(chart.svg);
    html += "</details>\n";
    first = false;
  }
  return section("maps", "Maps of the methods", html);
}

std::string intervals_section(const StabilityStudy &study)
{
  HtmlTable table({"method", "#damping ratio", "#from ω h", "#to ω h", "#largest growth per step", "#at ω h"});
  for (const MappedInterval &row : study.intervals)
  {
    const bool endless = std::isinf(row.interval.to);
    table.add({row.method, short_text(row.zeta), short_text(row.interval.from, 8), short_text(row.interval.to, 8),
               endless ? "–" : short_text(row.interval.growth, 6),
               endless ? "–" : short_text(row.interval.at_omega_h)});
  }
  return section("intervals", "Where each method grows",
                 table.html() + "<p class=\"soft\">Methods that are not listed grow nowhere. Exact propagation stands "
                                "here with the force of a closed contact on a free mass; modes of the base system it "
                                "carries exactly.</p>");
}

std::string padded(const std::string &text, std::size_t width, bool left = false)
{
  const std::size_t letters = n_letters(text);
  const std::string space(width > letters ? width - letters : 0, ' ');
  return left ? text + space : space + text;
}

std::string mode_row(const coupling::ModeAccuracy &mode)
{
  return "  " + padded(origin_text(mode.origin), 15, true) + padded(std::to_string(mode.number), 5) +
         padded(short_text(mode.mode.omega / two_pi, 6), 12) + padded(short_text(mode.mode.zeta), 10) +
         padded(short_text(mode.omega_h), 11) + padded(short_text(mode.spectral_radius, 7), 12) +
         padded(short_text(mode.numerical_damping, 3), 12) + padded(percent(mode.period_error), 12) + "   " +
         verdict_of(mode) + "\n";
}

} // namespace

std::string stability_text(const StabilityStudy &study)
{
  std::string text;
  if (!study.modes.empty())
  {
    text += study.method + "\n  modes of        mode      f [Hz]   damping    omega h  spec.radius   num.damping"
                           " period error   verdict\n";
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < study.modes.size(); ++i)
      if (i < most_rows || study.modes[i].unstable)
        text += mode_row(study.modes[i]);
      else
        ++left_out;
    if (left_out > 0)
      text += "  ... " + std::to_string(left_out) + " more, all stable, in stability_modes.csv\n";
    text += "other methods at this step\n  " + padded("method", 24, true) + padded("modes that grow", 16) +
            padded("worst [Hz]", 13) + padded("growth", 12) + padded("step that works", 17) +
            padded("period error", 14) + padded("highest mode", 14) + "\n";
    for (const MethodVerdict &verdict : study.verdicts)
    {
      const bool grows = verdict.growing > 0;
      text += "  " + padded(verdict.method, 24, true) + padded(std::to_string(verdict.growing), 16) +
              padded(grows ? short_text(verdict.worst_hz) : "-", 13) +
              padded(grows ? short_text(verdict.growth, 6) : "-", 12) +
              padded(!grows                         ? "-"
                     : verdict.step_that_works > 0. ? step_text(verdict.step_that_works)
                                                    : "none",
                     17) +
              padded(percent(verdict.lowest_period_error), 14) + padded(percent(verdict.highest_period_error), 14) +
              (verdict.only_closed ? "   while contacts are closed" : "") + "\n";
    }
    text += "  (period error: of the lowest and of the highest mode of the frame)\n";
  }
  for (const std::string &note : study.notes)
    text += note + "\n";
  return text;
}

std::string stability_page(const StabilityStudy &study)
{
  return page_html({study.title, "",
                    note_box(study.notes) + modes_section(study) + maps_section(study) + intervals_section(study),
                    "Computed with gestell " + escape_xml(study.version) +
                        ". All numbers stand in full precision in the .csv files beside this page.",
                    "details{margin:.6rem 0}summary{cursor:pointer;font-weight:600}"});
}

} // namespace gestell::apps

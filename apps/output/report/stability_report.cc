#include "apps/output/report/stability_report.h"

#include "apps/output/describe/described_json.h"
#include "apps/output/describe/described_table.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

/// The first rows, and all modes that grow.
std::vector<coupling::ModeAccuracy> listed_modes(const StabilityStudy &study)
{
  std::vector<coupling::ModeAccuracy> listed;
  constexpr std::size_t               most_rows = 40; // of modes in a terminal
  for (const coupling::ModeAccuracy &mode : study.modes)
    if (listed.size() < most_rows || mode.unstable)
      listed.push_back(mode);
  return listed;
}

std::string modes_section(const StabilityStudy &study)
{
  if (study.modes.empty())
    return "";
  return section(
      "modes", "Numerical damping and period error of " + escape_xml(study.method),
      table_of(study.modes).html() +
          "<p class=\"soft\">Numerical damping adds to the physical damping. With a positive period error the computed "
          "period is too long. Non-oscillatory modes are not listed.</p><h3>Other methods at this step</h3>" +
          table_of(study.verdicts).html());
}

std::string maps_section(const StabilityStudy &study)
{
  std::string html =
      "<p>Test oscillator x″ + 2ζω x′ + ω² x = 0 with step h. A mode with a spectral radius above 1 grows.";
  if (!study.modes.empty())
    html += " Ticks: modes of the frame (blue) and of the machine with closed contacts (orange) at the scene's step, "
            "from omega h = 0.01. Exact propagation has no error for modes of the frame. Methods without numerical "
            "damping or period error have no curve.";
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
  return section("maps", "Stability maps of the methods", html);
}

std::string intervals_section(const StabilityStudy &study)
{
  return section(
      "intervals", "Unstable intervals of the methods",
      table_of(study.intervals).html() +
          "<p class=\"soft\">Methods that are not listed are stable everywhere. For exact propagation, the listed "
          "intervals are those of a closed contact on a free mass; modes of the base system have no error.</p>");
}

} // namespace

std::string stability_text(const StabilityStudy &study)
{
  std::string text;
  if (!study.modes.empty())
  {
    const auto listed = listed_modes(study);
    text += study.method + '\n' + table_of(listed).terminal();
    if (listed.size() < study.modes.size())
      text +=
          "  ... " + std::to_string(study.modes.size() - listed.size()) + " more, all stable, in stability_modes.csv\n";
    text += "other methods at this step\n" + table_of(study.verdicts).terminal();
  }
  for (const std::string &note : study.notes)
    text += note + "\n";
  return text;
}

std::string stability_answer(const StabilityStudy &study)
{
  return json_text(described_json(study));
}

std::string stability_page(const StabilityStudy &study)
{
  return page_html({study.title, "",
                    note_box(study.notes) + modes_section(study) + maps_section(study) + intervals_section(study),
                    "Computed with gestell " + escape_xml(study.version) +
                        ". Full-precision values: the .csv files next to this page.",
                    "details{margin:.6rem 0}summary{cursor:pointer;font-weight:600}"});
}

} // namespace gestell::apps

#include "apps/output/report/machine_report.h"

#include "apps/output/charts/mode_charts.h"
#include "apps/output/pictures/skin_picture.h"
#include "apps/output/text/html.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr std::size_t most_pictures = 6;

} // namespace

std::string peak_figure(const Result &result, Pictures &pictures)
{
  if (!result.peak)
    return "";
  const PeakState   &peak  = *result.peak;
  const MachineState state = machine_state(result.scenery, peak.q);
  const double       times = shown_enlargement(state);
  const DisplayUnit  shown = display_unit(peak.unit, std::abs(peak.value));
  const std::string  when  = peak.signal + " = " + short_text(peak.value * shown.factor) + " " + shown.unit +
                           " at t = " + short_text(peak.t, 6) + " s",
                    svg = machine_state_svg(state, times, "At the peak: " + when,
                                            times > 0. ? "displacements " + short_text(times) + " times" : "",
                                            display_unit("m", state.skin.largest_displacement()));
  if (svg.empty())
    return "";
  pictures.emplace_back("machine-peak", svg);
  const std::string enlarged =
      times > 0. ? "; displacements of elasticity and play are drawn " + short_text(times) + " times as large" : "";
  const std::string edges = times > 0. && result.scenery.has_skin() ? ", the faint edges show the frame at rest" : "";
  return figure(svg, "The machine at its peak, " + escape_xml(when) +
                         ", the extreme of the first force asked for, or of the first signal" + enlarged + edges + ".");
}

std::string coupled_mode_pictures(const Result &result, Pictures &pictures)
{
  if (result.modes_at.size() == 0)
    return "";
  std::string html;
  for (std::size_t j = 0; j < std::min(result.coupled_modes.size(), most_pictures); ++j)
  {
    const std::string svg = coupled_mode_picture(result, result.scenery, j);
    if (svg.empty())
      return "";
    pictures.emplace_back("mode-machine-" + std::to_string(j + 1), svg);
    html += figure(svg);
  }
  return "<div class=\"modes\">" + html + "</div>\n";
}

} // namespace gestell::apps

#include "apps/output/report/machine_report.h"

#include "apps/output/charts/mode_charts.h"
#include "apps/output/interactive/machine_view.h"
#include "apps/output/pictures/machine_state.h"
#include "apps/output/pictures/mechanism_shapes.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

/// Whether bodies move so far that a second pose is informative.
bool far_apart(const std::vector<Shape> &before, const std::vector<Shape> &after, double machine_size)
{
  double way = 0.;
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t j = 0; j < std::min(before[i].points.size(), after[i].points.size()); ++j)
      way = std::max(way, (after[i].points[j] - before[i].points[j]).norm());
  constexpr double seen_motion = 0.02; // of the machine's size: a way that is seen in a picture of some 400 pixels
  return way > seen_motion * machine_size;
}

} // namespace

std::string machine_figure(const Result &result)
{
  const bool               runs   = result.run && !result.run->picture_states.empty();
  const Eigen::VectorXd    first  = runs ? result.run->picture_states.front() : result.modes_at;
  const std::vector<Shape> bodies = first.size() > 0 ? mechanism_shapes(result.scenery, first) : std::vector<Shape>();
  MachinePicture           picture{runs ? "motion" : "rest"};
  picture.enlargement = 0.;
  std::string caption = "Frame";
  if (!bodies.empty())
    caption = std::string("Mechanism") + (result.scenery.has_skin() ? " seen through the frame," : "") +
              (runs ? " at t = " + short_text(result.run->picture_times.front()) + " s"
                    : " in the configuration of the modes");
  if (runs)
    picture.t = result.run->picture_times.front();
  if (runs &&
      far_apart(bodies, mechanism_shapes(result.scenery, result.run->picture_states.back()), result.scenery.size()))
  {
    picture.later = result.run->picture_times.back();
    caption += "; outline: t = " + short_text(*picture.later) + " s";
  }
  return machine_picture(picture, caption + ".");
}

std::string peak_figure(const Result &result)
{
  if (!result.peak || !result.run || result.run->picture_states.empty())
    return "";
  const PeakState  &peak  = *result.peak;
  const double      times = shown_enlargement(machine_state(result.scenery, peak.q));
  const DisplayUnit shown = display_unit(peak.unit, std::abs(peak.value));
  const std::string when  = peak.signal + " = " + short_text(peak.value * shown.factor) + " " + shown.unit +
                           " at t = " + short_text(peak.t, 6) + " s";
  const std::string enlarged =
      times > 0. ? " Elastic and clearance displacements are enlarged " + short_text(times) + " times." : "";
  const std::string edges = times > 0. && result.scenery.has_skin() ? " Faint edges: frame at rest." : "";
  MachinePicture    picture{"motion"};
  picture.t           = peak.t;
  picture.enlargement = times;
  return machine_picture(picture,
                         "Machine at the main peak: " + escape_xml(when) +
                             " (extreme of the first force signal, or of the first signal if no force is recorded)." +
                             enlarged + edges);
}

std::string mode_pictures(const std::vector<coupling::Mode> &modes, const std::string &of, std::size_t most)
{
  std::string html;
  for (std::size_t j = 0; j < std::min(modes.size(), most); ++j)
    html +=
        machine_picture({of + "-" + std::to_string(j + 1)}, mode_heading(j, modes[j]) + ", " + damping_text(modes[j]));
  return "<div class=\"modes\">" + html + "</div>\n";
}

} // namespace gestell::apps

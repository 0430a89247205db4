#include "apps/output/charts/mode_charts.h"

#include "apps/output/charts/chart.h"
#include "apps/output/pictures/skin_picture.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr std::size_t most_bars = 10;

std::string heading(std::size_t j, const coupling::Mode &mode)
{
  return "Mode " + std::to_string(j + 1) + ": " + short_text(mode.frequency_hz) + " Hz" +
         (mode.growth > 0. ? ", grows by exp(" + short_text(mode.growth, 3) + " t/s)" : "");
}

std::string damping_text(const coupling::Mode &mode)
{
  return std::isnan(mode.damping_ratio) ? "does not vibrate"
                                        : "damping ratio " + short_text(100. * mode.damping_ratio, 3) + " %";
}

/// Whether coordinate i of the machine is an angle: of a rotor or a planar body, or a rotation of an interface.
bool is_angle(const Result &result, std::size_t i)
{
  for (const coupling::Body &body : result.scenery.bodies)
  {
    const bool rotor = body.kind == coupling::BodyKind::rotor, planar = body.kind == coupling::BodyKind::planar;
    const bool rigid = body.kind == coupling::BodyKind::rigid; // of a director: it moves by the angle it turns by
    const int  n     = rigid ? 12 : planar || body.kind == coupling::BodyKind::point ? 3 : 1;
    if (const int own = static_cast<int>(i) - body.coordinate; own >= 0 && own < n)
      return rotor || (planar && own == 2) || (rigid && own >= 3);
  }
  const std::string &name = i < result.coordinate_names.size() ? result.coordinate_names[i] : std::string();
  const std::string  end  = name.size() > 3 ? name.substr(name.size() - 3) : "";
  return end == ".rx" || end == ".ry" || end == ".rz";
}

/// Amplitudes of internal modes of a reduced frame say nothing to a reader.
bool is_physical(const Result &result, std::size_t i)
{
  const int first_mode = result.model.interface >= 0 ? result.model.interface : result.scenery.n_frame;
  const int k          = static_cast<int>(i);
  return k < first_mode || k >= result.scenery.n_frame;
}

/// What angles are multiplied with to stand beside displacements [m]: a crank, or half of the machine.
double arm(const Scenery &scenery)
{
  if (!scenery.rods.empty())
    return scenery.rods.front().crank_radius;
  const double half  = 0.5 * scenery.size();
  const double digit = std::pow(10., std::floor(std::log10(half)));
  return std::round(half / digit) * digit;
}

std::string bars_svg(const Result &result, const std::string &title, const coupling::Mode &mode)
{
  const double length = arm(result.scenery);

  BarChart chart;
  chart.title    = title;
  bool any_angle = false;
  for (long i = 0; i < mode.shape.size(); ++i)
  {
    const auto k = static_cast<std::size_t>(i);
    if (!is_physical(result, k))
      continue;
    const bool angle = is_angle(result, k);
    any_angle        = any_angle || angle;
    chart.bars.push_back({k < result.coordinate_names.size() ? result.coordinate_names[k] : "q" + std::to_string(i),
                          mode.shape(i) * (angle ? length : 1.), angle ? 1 : 0});
  }
  const auto larger = [](const Bar &a, const Bar &b) { return std::abs(a.value) > std::abs(b.value); };
  if (chart.bars.size() > most_bars)
  {
    std::stable_sort(chart.bars.begin(), chart.bars.end(), larger);
    chart.bars.resize(most_bars);
  }
  const auto largest = std::min_element(chart.bars.begin(), chart.bars.end(), larger);
  if (largest != chart.bars.end() && largest->value != 0.)
  {
    const double scale = 1. / largest->value;
    for (Bar &bar : chart.bars)
      bar.value *= scale;
  }
  chart.note = damping_text(mode);
  if (any_angle)
    chart.note += "; angles (second colour) times " + short_text(length) + " m";
  return bar_chart_svg(chart);
}

} // namespace

std::string frame_mode_svg(const Result &result, std::size_t j)
{
  const coupling::Mode &mode = result.frame_modes[j];
  if (!result.scenery.has_skin())
    return bars_svg(result, "Frame " + heading(j, mode), mode);
  return mode_picture_svg(skin_of(result.scenery, mode.shape), heading(j, mode), damping_text(mode));
}

std::string coupled_mode_svg(const Result &result, std::size_t j)
{
  return bars_svg(result, heading(j, result.coupled_modes[j]), result.coupled_modes[j]);
}

std::string shape_svg(const Result &result, const std::string &title, const coupling::Mode &mode)
{
  return bars_svg(result, title, mode);
}

} // namespace gestell::apps

#include "apps/output/charts/mode_charts.h"

#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

struct Bar
{
  std::string name;
  double      value;
  int         colour; ///< of the classes f0..f6
};

/// Horizontal bars about zero, one below the other, each with its name and value.
std::string bar_chart(const std::string &title, const std::vector<Bar> &bars, const std::string &note)
{
  constexpr double width = 420., row = 22., top = 34., letter_width = 6.9; // pixels

  double      largest = 0.;
  std::size_t longest = 0;
  for (const Bar &bar : bars)
  {
    largest = std::isfinite(bar.value) ? std::max(largest, std::abs(bar.value)) : largest;
    longest = std::max(longest, bar.name.size());
  }
  const double left = 20. + std::min(letter_width * static_cast<double>(longest), 0.45 * width);
  const double half = 0.5 * (width - left - 66.), zero = left + half + 8.;
  const double bottom = top + row * static_cast<double>(bars.size());

  std::string svg = svg_head(width, bottom + 30., title) + svg_text(10., 19., title, "title");
  double      y   = top;
  for (const Bar &bar : bars)
  {
    const double length = largest > 0. && std::isfinite(bar.value) ? half * bar.value / largest : 0.;
    svg += svg_text(left - 4., y + 14., bar.name, "label", "end") + "<rect class=\"f" + std::to_string(bar.colour) +
           "\" rx=\"1.5\"" + svg_box(std::min(zero, zero + length), y + 3., std::max(std::abs(length), 0.5), 14.) +
           "/>" +
           svg_text(width - 8., y + 14., short_text(std::abs(bar.value) < 5e-4 * largest ? 0. : bar.value, 3), "tick",
                    "end");
    y += row;
  }
  return svg + svg_line("axis", zero, top, zero, bottom) + svg_text(10., bottom + 20., note, "small") + "</svg>\n";
}

/// Whether coordinate i of the machine is an angle: of a rotor or a planar body, or a rotation of an interface.
bool is_angle(const Result &result, std::size_t i)
{
  for (const coupling::Body &body : result.scenery.bodies)
  {
    const bool rotor = body.kind == coupling::BodyKind::rotor, planar = body.kind == coupling::BodyKind::planar;
    const bool rigid = body.kind == coupling::BodyKind::rigid; // of a director, whose displacement is the rotation
    const int  n     = rigid ? 12 : planar || body.kind == coupling::BodyKind::point ? 3 : 1;
    if (const int own = static_cast<int>(i) - body.coordinate; own >= 0 && own < n)
      return rotor || (planar && own == 2) || (rigid && own >= 3);
  }
  const std::string &name = i < result.coordinate_names.size() ? result.coordinate_names[i] : std::string();
  const std::string  end  = name.size() > 3 ? name.substr(name.size() - 3) : "";
  return end == ".rx" || end == ".ry" || end == ".rz";
}

/// Amplitudes of internal modes of a reduced frame have no meaning for a reader.
bool is_physical(const Result &result, std::size_t i)
{
  const int first_mode = result.model.interface >= 0 ? result.model.interface : result.scenery.n_frame;
  const int k          = static_cast<int>(i);
  return k < first_mode || k >= result.scenery.n_frame;
}

/// Length [m] that converts angles into displacements for display: crank radius, or half the size of the machine.
double arm(const Scenery &scenery)
{
  if (!scenery.rods.empty())
    return scenery.rods.front().crank_radius;
  const double half  = 0.5 * scenery.size();
  const double digit = std::pow(10., std::floor(std::log10(half)));
  return std::round(half / digit) * digit;
}

} // namespace

double angle_arm(const Result &result)
{
  return arm(result.scenery);
}

std::string mode_heading(std::size_t j, const coupling::Mode &mode)
{
  return "Mode " + std::to_string(j + 1) + ": " + short_text(mode.frequency_hz) + " Hz" +
         (mode.growth > 0. ? ", grows by exp(" + short_text(mode.growth, 3) + " t/s)" : "");
}

std::string damping_text(const coupling::Mode &mode)
{
  return std::isnan(mode.damping_ratio) ? "no oscillation"
                                        : "damping ratio " + short_text(100. * mode.damping_ratio, 3) + " %";
}

std::string shape_svg(const Result &result, const std::string &title, const coupling::Mode &mode)
{
  const double length = arm(result.scenery);

  std::vector<Bar> bars;
  bool             any_angle = false;
  for (long i = 0; i < mode.shape.size(); ++i)
  {
    const auto k = static_cast<std::size_t>(i);
    if (!is_physical(result, k))
      continue;
    const bool angle = is_angle(result, k);
    any_angle        = any_angle || angle;
    bars.push_back({k < result.coordinate_names.size() ? result.coordinate_names[k] : "q" + std::to_string(i),
                    mode.shape(i) * (angle ? length : 1.), angle ? 1 : 0});
  }
  const auto            larger    = [](const Bar &a, const Bar &b) { return std::abs(a.value) > std::abs(b.value); };
  constexpr std::size_t most_bars = 10; // of a group: the names of more do not fit
  if (bars.size() > most_bars)
  {
    std::stable_sort(bars.begin(), bars.end(), larger);
    bars.resize(most_bars);
  }
  const auto largest = std::min_element(bars.begin(), bars.end(), larger);
  if (largest != bars.end() && largest->value != 0.)
  {
    const double scale = 1. / largest->value;
    for (Bar &bar : bars)
      bar.value *= scale;
  }
  std::string note = damping_text(mode);
  if (any_angle)
    note += "; angles (second colour) multiplied by " + short_text(length) + " m";
  return bar_chart(title, bars, note);
}

} // namespace gestell::apps

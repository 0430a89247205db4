#include "apps/output/charts/work_precision_chart.h"

#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr double width = 1000., height = 600., left = 78., right = 700., top = 64., bottom = 540.;

/// Logarithmic axes over whole decades.
struct LogFrame
{
  double x0, x1, y0, y1; // exponents of ten

  double px(double x) const { return left + (std::log10(x) - x0) / (x1 - x0) * (right - left); }
  double py(double y) const { return bottom - (std::log10(y) - y0) / (y1 - y0) * (bottom - top); }
};

std::string coordinate(double x)
{
  std::string text;
  append_coordinate(text, x);
  return text;
}

std::string segment(const std::string &attributes, double xa, double ya, double xb, double yb)
{
  return "<path " + attributes + " d=\"M" + coordinate(xa) + " " + coordinate(ya) + "L" + coordinate(xb) + " " +
         coordinate(yb) + "\"/>";
}

/// 10 to the n with raised digits.
std::string power(int n)
{
  static const char *const raised[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string              text     = n < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(n)))
    text += raised[digit - '0'];
  return text;
}

/// A time in the unit in which it reads well.
std::string seconds(double x)
{
  const double unit = x < 0.99e-3 ? 1e6 : x < 0.99 ? 1e3 : 1.;
  return short_text(x * unit, 4) + (unit == 1. ? " s" : unit == 1e3 ? " ms" : " µs");
}

/// A method's line: its front over both treatments of events.
struct Line
{
  std::string              method, family;
  std::vector<std::size_t> points;
  int                      style; ///< counts the methods of a family
};

std::vector<Line> lines_of(const WorkPrecision &chart, int model, WorkMeasure measure)
{
  std::vector<Line> lines;
  for (std::size_t i = 0; i < chart.points.size(); ++i)
  {
    const WorkPoint &point = chart.points[i];
    if (point.model != model || !point.failure.empty() || !std::isfinite(point.error) || !(point.error > 0.) ||
        point.error > 3. || !(work_of(point, measure) > 0.))
      continue;
    auto line = std::find_if(lines.begin(), lines.end(), [&](const Line &l) { return l.method == point.method; });
    if (line == lines.end())
    {
      const auto style =
          std::count_if(lines.begin(), lines.end(), [&](const Line &l) { return l.family == point.family; });
      line = lines.insert(lines.end(), {point.method, point.family, {}, int(style)});
    }
    line->points.push_back(i);
  }
  for (Line &line : lines)
  {
    std::sort(line.points.begin(), line.points.end(),
              [&](std::size_t a, std::size_t b)
              { return work_of(chart.points[a], measure) < work_of(chart.points[b], measure); });
    double best = std::numeric_limits<double>::infinity();
    line.points.erase(std::remove_if(line.points.begin(), line.points.end(),
                                     [&](std::size_t i)
                                     {
                                       if (chart.points[i].error >= best)
                                         return true;
                                       best = chart.points[i].error;
                                       return false;
                                     }),
                      line.points.end());
  }
  return lines;
}

LogFrame frame_of(const WorkPrecision &chart, const std::vector<Line> &lines, WorkMeasure measure)
{
  double x0 = 1e300, x1 = 0., y0 = 1e300, y1 = 0.;
  for (const Line &line : lines)
    for (const std::size_t i : line.points)
    {
      x0 = std::min(x0, work_of(chart.points[i], measure));
      x1 = std::max(x1, work_of(chart.points[i], measure));
      y0 = std::min(y0, chart.points[i].error);
      y1 = std::max(y1, chart.points[i].error);
    }
  if (!(x0 <= x1))
    return {-3., 0., -6., 0.};
  const double room = 0.08; // of a decade, so that markers do not lie on the border
  LogFrame     f{std::log10(x0) - room, std::log10(x1) + room, std::floor(std::log10(y0) - room),
             std::ceil(std::log10(y1) + room)};
  // Room for two ticks at least.
  const double missing = 0.8 - (f.x1 - f.x0);
  if (missing > 0.)
    f.x0 -= 0.5 * missing, f.x1 += 0.5 * missing;
  return f;
}

const char *dash(int style)
{
  static const std::array<const char *, 6> dashes = {"", "7 3", "2 3", "9 3 2 3", "4 2", "12 4 2 4 2 4"};
  return dashes[style % dashes.size()];
}

/// Square, disc, triangle, diamond in turn.
std::string marker(double x, double y, int style, int colour, bool resolved)
{
  const double      r    = 3.6;
  const std::string kind = "class=\"s" + std::to_string(colour) + (resolved ? " f" + std::to_string(colour) : "") +
                           "\"" + (resolved ? "" : " style=\"fill:var(--paper)\"");
  if (style % 4 == 0)
    return "<circle " + kind + " cx=\"" + coordinate(x) + "\" cy=\"" + coordinate(y) + "\" r=\"3.2\"/>";
  std::vector<std::pair<double, double>> corners;
  if (style % 4 == 1)
    corners = {{-2.8, -2.8}, {2.8, -2.8}, {2.8, 2.8}, {-2.8, 2.8}};
  else if (style % 4 == 2)
    corners = {{0., -r}, {r, 0.8 * r}, {-r, 0.8 * r}};
  else
    corners = {{0., -1.2 * r}, {1.1 * r, 0.}, {0., 1.2 * r}, {-1.1 * r, 0.}};
  std::string d;
  for (const auto &[dx, dy] : corners)
    d += (d.empty() ? "M" : "L") + coordinate(x + dx) + " " + coordinate(y + dy);
  return "<path " + kind + " d=\"" + d + "Z\"/>";
}

std::string stroke(int style, int colour)
{
  return "class=\"line s" + std::to_string(colour) +
         "\" style=\"stroke-dasharray:" + (*dash(style) != '\0' ? dash(style) : "none") + "\"";
}

std::string axes(const LogFrame &f, WorkMeasure measure)
{
  std::string svg;
  const bool  few = f.x1 - f.x0 < 2.5; // decades alone would leave the axis empty
  for (int n = int(std::floor(f.x0)); n <= f.x1 + 1e-9; ++n)
    for (const int times : {1, 2, 5})
    {
      const double value = times * std::pow(10., n), x = f.px(value);
      if ((times > 1 && !few) || x < left - 0.5 || x > right + 0.5)
        continue;
      const std::string number = measure == WorkMeasure::cpu ? seconds(value)
                                 : times == 1                ? power(n)
                                                             : std::to_string(times) + "·" + power(n);
      svg += segment("class=\"grid\"", x, top, x, bottom) + svg_text(x, bottom + 18., number, "tick", "middle");
    }
  for (int n = int(std::ceil(f.y0 - 1e-9)); n <= f.y1 + 1e-9; ++n)
  {
    const double y = f.py(std::pow(10., n));
    svg += segment("class=\"grid\"", left, y, right, y) + svg_text(left - 8., y + 4., power(n), "tick", "end");
  }
  svg += segment("class=\"axis\"", left, bottom, right, bottom) + segment("class=\"axis\"", left, top, left, bottom);
  svg += svg_text(0.5 * (left + right), bottom + 42.,
                  measure == WorkMeasure::cpu ? "CPU time of stepping" : "evaluations of forces or right-hand sides",
                  "label", "middle");
  return svg + svg_text(20., 0.5 * (top + bottom), "error (root mean square, scaled)", "label", "middle", -90.);
}

std::string legend(const std::vector<Line> &lines)
{
  std::string svg;
  double      y = top + 6.;
  std::string family;
  for (const Line &line : lines)
  {
    const int colour = family_colour(line.family);
    if (!family.empty() && line.family != family)
      y += 8.;
    family = line.family;
    svg += segment(stroke(line.style, colour), right + 22., y, right + 56., y) +
           marker(right + 39., y, line.style, colour, true) + svg_text(right + 64., y + 4., line.method, "label");
    y += 17.5;
  }
  return svg;
}

} // namespace

double work_of(const WorkPoint &point, WorkMeasure measure)
{
  return measure == WorkMeasure::cpu ? point.cpu_s : double(std::max(point.work.evaluations, point.work.newton));
}

int family_colour(const std::string &family)
{
  static const std::array<const char *, 7> families = {"BDF", "Newmark", "exact", "CVODE", "IDA", "ARKODE", "PETSc"};
  // Blue, orange, green, purple, dark grey, sky blue; the ochre, near to orange, comes last.
  static const std::array<int, 7> colours = {0, 1, 2, 3, 5, 6, 4};
  for (std::size_t i = 0; i < families.size(); ++i)
    if (family == families[i])
      return colours[i];
  return 4;
}

std::string work_precision_svg(const WorkPrecision &chart, int model, WorkMeasure measure)
{
  const std::vector<Line> lines = lines_of(chart, model, measure);
  const LogFrame          f     = frame_of(chart, lines, measure);
  const WorkModel        &size  = chart.models[model];
  const std::string       title =
      "Work and precision: " + chart.scene + ", " + std::to_string(size.coordinates) + " coordinates";

  std::string svg = svg_head(width, std::max(height, top + 40. + 20. * double(lines.size())), title);
  svg += svg_text(left, 24., title, "title");
  svg += svg_text(left, 44.,
                  "Each line is the better of events located and passed over; hollow: not resolved by the reference "
                  "(error " +
                      short_text(size.reference_error, 2) + ")",
                  "small");
  svg += axes(f, measure);
  const double limit = 10. * size.reference_error;
  if (limit > 0. && std::log10(limit) > f.y0)
  {
    const double y = std::max(top, f.py(limit));
    svg += "<rect x=\"" + coordinate(left) + "\" y=\"" + coordinate(y) + "\" width=\"" + coordinate(right - left) +
           "\" height=\"" + coordinate(bottom - y) + "\" style=\"fill:var(--ink);opacity:.06\"/>";
  }
  for (const Line &line : lines)
  {
    const int   colour = family_colour(line.family);
    std::string path, markers;
    for (const std::size_t i : line.points)
    {
      const WorkPoint &point = chart.points[i];
      const double     x = f.px(work_of(point, measure)), y = f.py(point.error);
      path += (path.empty() ? "M" : "L") + coordinate(x) + " " + coordinate(y);
      markers += "<g><title>" +
                 escape_xml(point.method + ", " +
                            (point.step > 0. ? "step " + short_text(point.step * 1e6, 4) + " us"
                                             : "tolerance " + short_text(point.tolerance, 2)) +
                            (point.events ? ", events located" : ", events passed over")) +
                 "</title>" + marker(x, y, line.style, colour, point.resolved) + "</g>";
    }
    svg += "<path " + stroke(line.style, colour) + " d=\"" + path + "\"/>" + markers + "\n";
  }
  return svg + legend(lines) + "</svg>\n";
}

} // namespace gestell::apps

#include "apps/output/charts/log_chart.h"

#include "apps/output/charts/chart.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr double left = 58., right = 10., bottom = 40., head = 30., panel_title = 20., legend_row = 16.;
constexpr double letter      = 6.6; ///< width of a 12 px letter, on average
constexpr int    not_a_power = -100;

struct Axis
{
  double begin, end; // of the values, as logarithms if `log`
  bool   log;
  double first, last; // in the picture

  double at(double value) const
  {
    const double v = log ? std::log10(value) : value;
    return std::clamp(first + (v - begin) / (end - begin) * (last - first), -2000., 5000.);
  }
};

Axis axis(double begin, double end, bool log, double first, double last)
{
  if (!(end > begin) || (log && !(begin > 0.)))
    throw std::invalid_argument("log chart: an axis from " + exact_text(begin) + " to " + exact_text(end) +
                                " is empty; begin below the end, a logarithmic one above zero.");
  return log ? Axis{std::log10(begin), std::log10(end), true, first, last} : Axis{begin, end, false, first, last};
}

std::string path(const std::string &style, double x0, double y0, double x1, double y1)
{
  std::string svg = "<path class=\"" + style + "\" d=\"M";
  append_coordinate(svg, x0);
  append_coordinate(svg += ' ', y0);
  append_coordinate(svg += 'L', x1);
  append_coordinate(svg += ' ', y1);
  return svg + "\"/>";
}

std::string box(const std::string &opening, double x, double y, double width, double height)
{
  std::string svg = opening + " x=\"";
  append_coordinate(svg, x);
  append_coordinate(svg += "\" y=\"", y);
  append_coordinate(svg += "\" width=\"", width);
  append_coordinate(svg += "\" height=\"", height);
  return svg + "\"";
}

/// "10" with a raised exponent; 0.01 to 100 as they are.
std::string power_label(double x, double y, int exponent, const std::string &anchor)
{
  if (exponent >= -2 && exponent <= 3)
    return svg_text(x, y, short_text(std::pow(10., exponent), 6), "tick", anchor);
  std::string svg = "<text class=\"tick\" text-anchor=\"" + anchor + "\" x=\"";
  append_coordinate(svg, x);
  append_coordinate(svg += "\" y=\"", y);
  return svg + "\">10<tspan dy=\"-4\" font-size=\"9\">" + (exponent < 0 ? "−" : "") +
         std::to_string(std::abs(exponent)) + "</tspan></text>\n";
}

struct Area
{
  double left, right, top, bottom;
};

/// Less than two powers of ten in sight are told apart by 2 and 5 between them, written in full.
bool short_axis(const Axis &axis)
{
  return axis.end - axis.begin < 2.;
}

/// Calls draw(value, exponent) for the ticks of a logarithmic axis; exponent not_a_power where it is to be
/// written in full.
template <typename Draw>
void log_ticks(const Axis &axis, int every, const Draw &draw)
{
  constexpr double rounding = 1e-9;
  for (int e = static_cast<int>(std::floor(axis.begin - rounding)); e <= axis.end + rounding; ++e)
    for (const double part : {1., 2., 5.})
    {
      const double value = part * std::pow(10., e);
      const double v     = std::log10(value);
      if (v < axis.begin - rounding || v > axis.end + rounding)
        continue;
      if (short_axis(axis))
        draw(value, not_a_power);
      else if (part == 1. && e % every == 0)
        draw(value, e);
    }
}

std::string log_label(double x, double y, double value, int exponent, const std::string &anchor)
{
  return exponent == not_a_power ? svg_text(x, y, short_text(value, 6), "tick", anchor)
                                 : power_label(x, y, exponent, anchor);
}

std::string x_axis(const LogChart &chart, const Axis &x, const Area &area)
{
  std::string svg;
  log_ticks(x, 1,
            [&](double value, int exponent)
            {
              const double px = x.at(value);
              svg += path("grid", px, area.top, px, area.bottom) +
                     log_label(px, area.bottom + 16., value, exponent, "middle");
            });
  return svg + svg_text(0.5 * (area.left + area.right), area.bottom + 33., chart.x_label, "label", "middle");
}

std::string y_axis(const LogChart &chart, const Axis &y, const Area &area)
{
  std::string svg;
  if (chart.log_y)
    log_ticks(y, static_cast<int>(std::ceil((y.end - y.begin) / 8.)),
              [&](double value, int exponent)
              {
                const double py = y.at(value);
                svg += path("grid", area.left, py, area.right, py) +
                       log_label(area.left - 6., py + 4., value, exponent, "end");
              });
  else
    for (const double value : nice_ticks(chart.y_begin, chart.y_end, 6))
      svg += path("grid", area.left, y.at(value), area.right, y.at(value)) +
             svg_text(area.left - 6., y.at(value) + 4., short_text(value, 4), "tick", "end");
  return svg + svg_text(area.left - 44., 0.5 * (area.top + area.bottom), chart.y_label, "label", "middle", -90.);
}

std::string line_style(const LogCurve &curve)
{
  return "line s" + std::to_string(curve.colour % n_series_colours) + (curve.dashed ? " dash" : "");
}

std::string ring(const LogCurve &curve, double x, double y)
{
  std::string svg = "<circle class=\"" + line_style(curve) + "\" r=\"4\" cx=\"";
  append_coordinate(svg, x);
  append_coordinate(svg += "\" cy=\"", y);
  return svg + "\"/>";
}

std::string polyline(const LogCurve &curve, const Axis &x, const Axis &y)
{
  if (curve.x.size() != curve.y.size())
    throw std::invalid_argument("log chart: curve \"" + curve.name + "\" has " + std::to_string(curve.x.size()) +
                                " abscissae and " + std::to_string(curve.y.size()) + " values.");
  std::string points, rings;
  bool        pen_down = false;
  for (std::size_t i = 0; i < curve.x.size(); ++i)
  {
    const bool drawn = curve.x[i] > 0. && std::isfinite(curve.y[i]) && (!y.log || curve.y[i] > 0.);
    if (drawn && curve.points)
      rings += ring(curve, x.at(curve.x[i]), y.at(curve.y[i]));
    else if (drawn)
    {
      append_coordinate(points += pen_down ? 'L' : 'M', x.at(curve.x[i]));
      append_coordinate(points += ' ', y.at(curve.y[i]));
    }
    pen_down = drawn;
  }
  if (curve.points)
    return rings + "\n";
  return points.empty() ? "" : "<path class=\"" + line_style(curve) + "\" d=\"" + points + "\"/>\n";
}

int legend_rows(const LogPanel &panel, double width)
{
  double x    = 0.;
  int    rows = 1;
  for (const LogCurve &curve : panel.curves)
  {
    const double entry = curve.name.empty() ? 0. : 34. + letter * static_cast<double>(curve.name.size());
    if (x > 0. && x + entry > width)
    {
      x = 0.;
      ++rows;
    }
    x += entry;
  }
  return rows;
}

std::string legend(const LogPanel &panel, double x0, double y0, double width)
{
  std::string svg;
  double      x = 0., y = y0;
  for (const LogCurve &curve : panel.curves)
  {
    if (curve.name.empty())
      continue;
    const double entry = 34. + letter * static_cast<double>(curve.name.size());
    if (x > 0. && x + entry > width)
    {
      x = 0.;
      y += legend_row;
    }
    svg +=
        curve.points ? ring(curve, x0 + x + 9., y - 4.) : path(line_style(curve), x0 + x, y - 4., x0 + x + 18., y - 4.);
    svg += svg_text(x0 + x + 22., y, curve.name, "label");
    x += entry;
  }
  return svg;
}

/// Height of the panels' titles; none has one where there is a single panel.
double title_height(const LogChart &chart)
{
  return std::all_of(chart.panels.begin(), chart.panels.end(), [](const LogPanel &p) { return p.title.empty(); })
             ? 0.
             : panel_title;
}

std::string draw_panel(const LogChart &chart, const LogPanel &panel, double x0, double y0, int rows)
{
  const Area area{x0 + left, x0 + chart.panel_width - right, y0 + title_height(chart) + legend_row * rows + 6.,
                  y0 + title_height(chart) + legend_row * rows + 6. + chart.panel_height - bottom};
  const Axis x = axis(chart.x_begin, chart.x_end, true, area.left, area.right);
  const Axis y = axis(chart.y_begin, chart.y_end, chart.log_y, area.bottom, area.top);

  std::string svg = svg_text(area.left, y0 + 13., panel.title, "title");
  svg += legend(panel, area.left, y0 + title_height(chart) + 13., area.right - area.left);
  if (!std::isnan(chart.limit))
  {
    const double limit = y.at(chart.limit);
    svg +=
        box("<rect class=\"f1\" opacity=\".09\"", area.left, area.top, area.right - area.left, limit - area.top) + "/>";
    svg += path("zero", area.left, limit, area.right, limit);
  }
  svg += x_axis(chart, x, area) + y_axis(chart, y, area);
  svg += path("axis", area.left, area.bottom, area.right, area.bottom) +
         path("axis", area.left, area.top, area.left, area.bottom);
  for (const LogMark &mark : chart.marks)
    if (mark.x >= chart.x_begin && mark.x <= chart.x_end)
      svg += "<g><title>" + escape_xml(mark.text) + "</title>" +
             path("line s" + std::to_string(mark.colour % n_series_colours), x.at(mark.x), area.bottom - 14.,
                  x.at(mark.x), area.bottom) +
             "</g>\n";
  std::string view = box("<svg", area.left, area.top, area.right - area.left, area.bottom - area.top) + " viewBox=\"";
  append_coordinate(view, area.left);
  append_coordinate(view += ' ', area.top);
  append_coordinate(view += ' ', area.right - area.left);
  append_coordinate(view += ' ', area.bottom - area.top);
  svg += view + "\">\n";
  for (const LogCurve &curve : panel.curves)
    svg += polyline(curve, x, y);
  return svg + "</svg>\n";
}

} // namespace

std::string log_chart_svg(const LogChart &chart)
{
  int rows = 1;
  for (const LogPanel &panel : chart.panels)
    rows = std::max(rows, legend_rows(panel, chart.panel_width - left - right));
  const int    columns = std::max(1, std::min(chart.columns, static_cast<int>(chart.panels.size())));
  const int    lines   = (static_cast<int>(chart.panels.size()) + columns - 1) / columns;
  const double height  = title_height(chart) + legend_row * rows + 6. + chart.panel_height + 8.;

  std::string svg = svg_head(columns * chart.panel_width + 8., head + lines * height, chart.title) +
                    svg_text(14., 20., chart.title, "title");
  for (std::size_t i = 0; i < chart.panels.size(); ++i)
    svg += draw_panel(chart, chart.panels[i], static_cast<double>(i % columns) * chart.panel_width,
                      head + static_cast<double>(i / columns) * height, rows);
  return svg + "</svg>\n";
}

} // namespace gestell::apps

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

constexpr double left_margin = 70., right_margin = 18., bottom_margin = 46., title_height = 26., legend_height = 19.;
constexpr double letter_width = 6.9; ///< of the 12 px letters, on average

/// Linear map of the window [x0, x1] x [y0, y1] of values to the drawing area.
struct Frame
{
  double x0, x1, y0, y1;
  double left, right, top, bottom;

  double px(double x) const { return left + (x - x0) / (x1 - x0) * (right - left); }
  double py(double y) const { return bottom - (y - y0) / (y1 - y0) * (bottom - top); }
};

struct Window
{
  std::size_t begin, end; // of the abscissae shown
};

Window window_of(const LineChart &chart, double x0, double x1)
{
  const auto first = std::lower_bound(chart.x.begin(), chart.x.end(), x0);
  const auto last  = std::upper_bound(chart.x.begin(), chart.x.end(), x1);
  return {static_cast<std::size_t>(first - chart.x.begin()), static_cast<std::size_t>(last - chart.x.begin())};
}

/// Widens [low, high] a little, and to something where it is a point.
void add_room(double &low, double &high)
{
  if (!(low <= high))
    low = -1., high = 1.;
  const double span = high - low, least = 1e-9 * std::max({std::abs(low), std::abs(high), 1e-30});
  const double room = span > least ? 0.05 * span : std::max(0.05 * std::abs(high), 1e-12);
  low -= room;
  high += room;
}

struct LegendEntry
{
  double x;
  int    row;
};

std::vector<LegendEntry> legend_layout(const LineChart &chart, int &rows)
{
  std::vector<LegendEntry> entries;
  double                   x = left_margin;
  rows                       = 1;
  for (const Series &series : chart.series)
  {
    const double width = 34. + letter_width * static_cast<double>(series.name.size());
    if (x + width > chart.width - right_margin && x > left_margin)
    {
      x = left_margin;
      ++rows;
    }
    entries.push_back({x, rows - 1});
    x += width + 10.;
  }
  return entries;
}

std::string line_class(std::size_t i)
{
  return "line s" + std::to_string(i % n_series_colours) + (i % 2 == 1 ? " dash" : "");
}

std::string segment(const char *style, double x0, double y0, double x1, double y1)
{
  std::string svg = std::string("<path class=\"") + style + "\" d=\"M";
  append_coordinate(svg, x0);
  append_coordinate(svg += ' ', y0);
  append_coordinate(svg += 'L', x1);
  append_coordinate(svg += ' ', y1);
  return svg + "\"/>";
}

std::string axes(const LineChart &chart, const Frame &f)
{
  std::string svg;
  for (const double x : chart.x_ticks.empty() ? nice_ticks(f.x0, f.x1, 8) : chart.x_ticks)
    svg += segment("grid", f.px(x), f.top, f.px(x), f.bottom) +
           svg_text(f.px(x), f.bottom + 17., short_text(x, 6), "tick", "middle");
  for (const double y : nice_ticks(f.y0, f.y1, 6))
    svg += segment("grid", f.left, f.py(y), f.right, f.py(y)) +
           svg_text(f.left - 7., f.py(y) + 4., short_text(y, 6), "tick", "end");
  if (f.y0 < 0. && f.y1 > 0.)
    svg += segment("zero", f.left, f.py(0.), f.right, f.py(0.));
  svg += segment("axis", f.left, f.bottom, f.right, f.bottom) + segment("axis", f.left, f.top, f.left, f.bottom);
  svg += svg_text(0.5 * (f.left + f.right), f.bottom + 37., chart.x_label, "label", "middle");
  svg += svg_text(17., 0.5 * (f.top + f.bottom), chart.y_label, "label", "middle", -90.);
  return svg;
}

/// Event lines; numbers only where they do not collide.
std::string event_lines(const LineChart &chart, const Frame &f)
{
  std::string svg;
  double      free_from = f.left;
  for (const EventMark &mark : chart.marks)
  {
    if (mark.x < f.x0 || mark.x > f.x1)
      continue;
    const double x = f.px(mark.x);
    svg += "<g><title>" + escape_xml(mark.text) + "</title>" + segment("event", x, f.top, x, f.bottom);
    const std::string number = std::to_string(mark.number);
    const double      half   = 3.2 * static_cast<double>(number.size());
    if (x - half >= free_from)
    {
      svg += svg_text(x, f.top - 4., number, "small", "middle");
      free_from = x + half + 2.;
    }
    svg += "</g>\n";
  }
  return svg;
}

/// Names only where they do not collide, the lowest first.
std::string level_lines(const LineChart &chart, const Frame &f)
{
  std::vector<Level> levels = chart.levels;
  std::stable_sort(levels.begin(), levels.end(), [](const Level &a, const Level &b) { return a.y < b.y; });
  std::string svg;
  double      free_below = f.bottom;
  for (const Level &level : levels)
  {
    if (level.y < f.y0 || level.y > f.y1)
      continue;
    const double y = f.py(level.y);
    svg += "<g><title>" + escape_xml(level.name) + "</title>" + segment("event", f.left, y, f.right, y);
    if (y - 3. <= free_below)
    {
      svg += svg_text(f.right - 4., y - 3., level.name, "small", "end");
      free_below = y - 14.;
    }
    svg += "</g>\n";
  }
  return svg;
}

std::string rings(const LineChart &chart, const Frame &f)
{
  std::string svg;
  for (const Ring &ring : chart.rings)
  {
    if (ring.x < f.x0 || ring.x > f.x1 || ring.y < f.y0 || ring.y > f.y1)
      continue;
    std::string x, y;
    append_coordinate(x, f.px(ring.x));
    append_coordinate(y, f.py(ring.y));
    svg += "<g><title>" + escape_xml(ring.text) + "</title><circle class=\"axis\" cx=\"" + x + "\" cy=\"" + y +
           "\" r=\"4.5\"/></g>\n";
  }
  return svg;
}

/// One curve as a path; per column of pixels at most four points in the order in which they occur.
std::string curve(const LineChart &chart, const std::vector<double> &y, const Window &window, const Frame &f)
{
  std::string path;
  bool        pen_down = false;
  const auto  draw_to  = [&](std::size_t i)
  {
    path += pen_down ? 'L' : 'M';
    append_coordinate(path, f.px(chart.x[i]));
    append_coordinate(path += ' ', f.py(y[i]));
    pen_down = true;
  };
  // One abscissa beyond either end lets the line run out of the window; the caller clips.
  const std::size_t begin = window.begin > 0 ? window.begin - 1 : 0, end = std::min(window.end + 1, chart.x.size());
  for (std::size_t i = begin; i < end;)
  {
    if (!std::isfinite(y[i]))
    {
      pen_down = false;
      ++i;
      continue;
    }
    const double column = std::floor(f.px(chart.x[i]));
    std::size_t  last = i, low = i, high = i;
    for (std::size_t k = i; k < end && std::isfinite(y[k]) && std::floor(f.px(chart.x[k])) == column; ++k)
    {
      last = k;
      low  = y[k] < y[low] ? k : low;
      high = y[k] > y[high] ? k : high;
    }
    std::size_t previous = end;
    for (const std::size_t k : {i, std::min(low, high), std::max(low, high), last})
      if (k != previous)
        draw_to(previous = k);
    i = last + 1;
  }
  return path;
}

std::string legend(const LineChart &chart, const std::vector<LegendEntry> &entries)
{
  std::string svg;
  for (std::size_t i = 0; i < entries.size(); ++i)
  {
    const double y = title_height + 12. + legend_height * entries[i].row;
    svg += segment(line_class(i).c_str(), entries[i].x, y - 4., entries[i].x + 24., y - 4.);
    svg += svg_text(entries[i].x + 30., y, chart.series[i].name, "label");
  }
  return svg;
}

Frame frame_of(const LineChart &chart, const Window &window, double x0, double x1, int legend_rows)
{
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Series &series : chart.series)
    for (std::size_t i = window.begin; i < window.end; ++i)
      if (std::isfinite(series.y[i]))
      {
        low  = std::min(low, series.y[i]);
        high = std::max(high, series.y[i]);
      }
  add_room(low, high);
  low              = std::isnan(chart.y_begin) ? low : chart.y_begin;
  high             = std::isnan(chart.y_end) ? high : chart.y_end;
  const double top = title_height + legend_height * legend_rows + (chart.marks.empty() ? 8. : 18.);
  return {x0, x1, low, high, left_margin, chart.width - right_margin, top, chart.height - bottom_margin};
}

} // namespace

std::vector<double> nice_ticks(double low, double high, int count)
{
  if (!(high > low) || count < 1)
    return {};
  const double rough = (high - low) / count, power = std::pow(10., std::floor(std::log10(rough)));
  const double step = power * (rough <= 1.5 * power ? 1. : rough <= 3.5 * power ? 2. : rough <= 7.5 * power ? 5. : 10.);

  std::vector<double> ticks;
  for (long i = static_cast<long>(std::ceil(low / step - 1e-9)); i * step <= high + 1e-9 * step; ++i)
    ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

std::string line_chart_svg(const LineChart &chart)
{
  for (const Series &series : chart.series)
    if (series.y.size() != chart.x.size())
      throw std::invalid_argument("line chart \"" + chart.title + "\": series \"" + series.name + "\" has " +
                                  std::to_string(series.y.size()) + " values, its abscissa has " +
                                  std::to_string(chart.x.size()) + "; give one value per abscissa.");

  double x0 = std::isnan(chart.x_begin) ? (chart.x.empty() ? 0. : chart.x.front()) : chart.x_begin;
  double x1 = std::isnan(chart.x_end) ? (chart.x.empty() ? 1. : chart.x.back()) : chart.x_end;
  if (!(x1 > x0))
    add_room(x0, x1);

  int          rows    = 1;
  const auto   entries = legend_layout(chart, rows);
  const Window window  = window_of(chart, x0, x1);
  const Frame  f       = frame_of(chart, window, x0, x1, rows);

  std::string svg = svg_head(chart.width, chart.height, chart.title);
  svg += svg_text(left_margin, 18., chart.title, "title");
  svg += axes(chart, f) + event_lines(chart, f) + level_lines(chart, f);
  std::string x, y, w, h;
  append_coordinate(x, f.left);
  append_coordinate(y, f.top);
  append_coordinate(w, f.right - f.left);
  append_coordinate(h, f.bottom - f.top);
  svg += "<svg x=\"" + x + "\" y=\"" + y + "\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"" + x + " " + y +
         " " + w + " " + h + "\">\n";
  for (std::size_t i = 0; i < chart.series.size(); ++i)
    svg += "<path class=\"" + line_class(i) + "\" d=\"" + curve(chart, chart.series[i].y, window, f) + "\"/>\n";
  return svg + "</svg>\n" + rings(chart, f) + legend(chart, entries) + "</svg>\n";
}

std::string bar_chart_svg(const BarChart &chart)
{
  constexpr double row = 22., top = 34.;

  double      largest = 0.;
  std::size_t longest = 0;
  for (const Bar &bar : chart.bars)
  {
    largest = std::isfinite(bar.value) ? std::max(largest, std::abs(bar.value)) : largest;
    longest = std::max(longest, bar.name.size());
  }
  const double left = 20. + std::min(letter_width * static_cast<double>(longest), 0.45 * chart.width);
  const double half = 0.5 * (chart.width - left - 66.), zero = left + half + 8.;
  const double height = top + row * static_cast<double>(chart.bars.size()) + (chart.note.empty() ? 10. : 30.);

  std::string svg = svg_head(chart.width, height, chart.title) + svg_text(10., 19., chart.title, "title");
  for (std::size_t i = 0; i < chart.bars.size(); ++i)
  {
    const Bar   &bar    = chart.bars[i];
    const double y      = top + row * static_cast<double>(i);
    const double length = largest > 0. && std::isfinite(bar.value) ? half * bar.value / largest : 0.;
    svg += svg_text(left - 4., y + 14., bar.name, "label", "end");
    std::string x, w, py;
    append_coordinate(x, std::min(zero, zero + length));
    append_coordinate(w, std::max(std::abs(length), 0.5));
    append_coordinate(py, y + 3.);
    svg += "<rect class=\"f" + std::to_string(bar.colour % n_series_colours) + "\" x=\"" + x + "\" y=\"" + py +
           "\" width=\"" + w + "\" height=\"14\" rx=\"1.5\"/>";
    svg += svg_text(chart.width - 8., y + 14., short_text(std::abs(bar.value) < 5e-4 * largest ? 0. : bar.value, 3),
                    "tick", "end");
  }
  svg += segment("axis", zero, top, zero, top + row * static_cast<double>(chart.bars.size()));
  if (!chart.note.empty())
    svg += svg_text(10., height - 10., chart.note, "small");
  return svg + "</svg>\n";
}

} // namespace gestell::apps

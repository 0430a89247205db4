#include "apps/output/charts/chart.h"

#include "apps/output/text/page_language.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

constexpr double left_margin = 68., right_margin = 18., bottom_margin = 44.;                        ///< pixels
constexpr double title_height = 28., note_height = 18., panel_title_height = 20., legend_row = 17.; ///< pixels

/// The drawing area of a panel with its axes.
struct Area
{
  double  left, right, top, bottom;
  AxisMap x, y;
};

std::string colour_class(int colour)
{
  return std::to_string(colour % n_series_colours);
}

// Axes

struct Range
{
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  void add(double value)
  {
    low  = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Calls use(x, y) for the points that both axes have a place for.
template <typename Use>
void for_each_point(const Chart &chart, const Use &use)
{
  for (const Panel &panel : chart.panels)
    for (const Curve &curve : panel.curves)
      for (std::size_t i = 0; i < curve.x.size(); ++i)
        if (chart.x.has_place(curve.x[i]) && chart.y.has_place(curve.y[i]))
          use(curve.x[i], curve.y[i]);
}

/// The chart without its panels, with both limits of both axes; limits of the ordinate follow from the values inside
/// those of the abscissa.
Chart with_axes(const Chart &described)
{
  Chart chart{described.title,   described.note,         described.x,      described.y,     {},
              described.marks,   described.levels,       described.shades, described.width, described.height,
              described.columns, described.legend_column};
  Range x, y;
  for_each_point(described, [&](double value, double) { x.add(value); });
  chart.x = fitted(chart.x, x.low, x.high, 0.);
  for_each_point(described,
                 [&](double at, double value)
                 {
                   if (chart.x.shows(at))
                     y.add(value);
                 });
  chart.y = fitted(chart.y, y.low, y.high, 0.05);
  return chart;
}

std::string axes(const Chart &chart, const Area &area)
{
  std::string svg;
  for (const Tick &tick : ticks_of(chart.x, static_cast<int>(chart.width / 110.)))
  {
    const double x = area.x.at(tick.value);
    svg += svg_line("grid", x, area.top, x, area.bottom) + svg_text(x, area.bottom + 17., tick.text, "tick", "middle");
  }
  for (const Tick &tick : ticks_of(chart.y, static_cast<int>(chart.height / 40.)))
  {
    const double y = area.y.at(tick.value);
    svg += svg_line("grid", area.left, y, area.right, y) + svg_text(area.left - 7., y + 4., tick.text, "tick", "end");
  }
  if (chart.y.begin < 0. && chart.y.end > 0.)
    svg += svg_line("zero", area.left, area.y.at(0.), area.right, area.y.at(0.));
  svg += svg_line("axis", area.left, area.bottom, area.right, area.bottom) +
         svg_line("axis", area.left, area.top, area.left, area.bottom);
  return svg + svg_text(0.5 * (area.left + area.right), area.bottom + 36., chart.x.label, "label", "middle") +
         svg_text(area.left - 52., 0.5 * (area.top + area.bottom), chart.y.label, "label", "middle", -90.);
}

// Elements drawn before the curves

std::string shades(const Chart &chart, const Area &area)
{
  std::string svg;
  for (const Shade &shade : chart.shades)
  {
    const double from = area.y.at(std::clamp(shade.begin, chart.y.begin, chart.y.end));
    const double to   = area.y.at(std::clamp(shade.end, chart.y.begin, chart.y.end));
    svg += "<rect class=\"f" + colour_class(shade.colour) + "\" opacity=\".09\"" +
           svg_box(area.left, to, area.right - area.left, from - to) + "/>";
    for (const double edge : {from, to})
      if (edge > area.top && edge < area.bottom)
        svg += svg_line("zero", area.left, edge, area.right, edge);
  }
  return svg;
}

/// Numbers only where they do not collide; a line nearer than `close` to the one before is a tick at the top, so that
/// many events do not hide the curves.
std::string marks(const Chart &chart, const Area &area)
{
  std::string svg;
  double      free_from = area.left, last_line = -std::numeric_limits<double>::infinity();
  for (const Mark &mark : chart.marks)
  {
    if (!chart.x.shows(mark.x))
      continue;
    const double      x      = area.x.at(mark.x);
    const std::string number = std::to_string(mark.number);
    const double      half   = 3.2 * static_cast<double>(number.size());
    constexpr double  close  = 8.; // px between lines of events
    std::string       line   = mark.number > 0
                                   ? svg_line("event", x, area.top, x, x < last_line + close ? area.top + 7. : area.bottom)
                                   : svg_line("line s" + colour_class(mark.colour), x, area.bottom - 14., x, area.bottom);
    if (mark.number > 0 && x >= last_line + close)
      last_line = x;
    if (mark.number > 0 && x - half >= free_from)
    {
      line += svg_text(x, area.top - 4., number, "small", "middle");
      free_from = x + half + 2.;
    }
    svg += svg_hint(mark.text, line);
  }
  return svg;
}

/// Names only where they do not collide, the lowest first.
std::string levels(const Chart &chart, const Area &area)
{
  std::vector<Level> sorted = chart.levels;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Level &a, const Level &b) { return a.y < b.y; });
  std::string svg;
  double      free_below = area.bottom;
  for (const Level &level : sorted)
  {
    if (!chart.y.shows(level.y))
      continue;
    const double y    = area.y.at(level.y);
    std::string  line = svg_line("event", area.left, y, area.right, y);
    if (y - 3. <= free_below)
    {
      line += svg_text(area.right - 4., y - 3., level.name, "small", "end");
      free_below = y - 14.;
    }
    svg += svg_hint(level.name, line);
  }
  return svg;
}

std::string tiles(const Panel &panel, const Chart &chart, const Area &area)
{
  std::string svg;
  for (const Tile &tile : panel.tiles)
  {
    const double left  = area.x.at(std::max(tile.x_begin, chart.x.begin));
    const double right = area.x.at(std::min(tile.x_end, chart.x.end));
    const double low   = area.y.at(std::max(tile.y_begin, chart.y.begin));
    const double high  = area.y.at(std::min(tile.y_end, chart.y.end));
    if (!(right > left) || !(low > high))
      continue;
    const std::string box = "<rect class=\"f" + colour_class(tile.colour) + "\"" +
                            svg_box(left, high, right - left, low - high) + " shape-rendering=\"crispEdges\"/>";
    svg += tile.text.empty() ? box : svg_hint(tile.text, box);
  }
  return svg;
}

// Curves

std::string line_class(const Curve &curve)
{
  return "line s" + colour_class(curve.colour) + " d" + std::to_string(static_cast<int>(curve.line));
}

std::string marker(const Curve &curve, double x, double y, bool hollow)
{
  constexpr double                       r    = 3.6; // radius of a mark
  const std::string                      n    = colour_class(curve.colour);
  const std::string                      kind = curve.marker == Marker::ring ? " class=\"line s" + n + "\""
                                                : hollow ? " class=\"s" + n + "\" style=\"fill:var(--paper)\""
                                                         : " class=\"s" + n + " f" + n + "\"";
  std::vector<std::pair<double, double>> corners;
  switch (curve.marker)
  {
  case Marker::none:
    return "";
  case Marker::disc:
  case Marker::ring:
    return "<circle" + kind + " cx=\"" + coordinate(x) + "\" cy=\"" + coordinate(y) + "\" r=\"" +
           (curve.marker == Marker::disc ? "3.2" : "4") + "\"/>";
  case Marker::square:
    corners = {{-2.8, -2.8}, {2.8, -2.8}, {2.8, 2.8}, {-2.8, 2.8}};
    break;
  case Marker::triangle:
    corners = {{0., -r}, {r, 0.8 * r}, {-r, 0.8 * r}};
    break;
  case Marker::diamond:
    corners = {{0., -1.2 * r}, {1.1 * r, 0.}, {0., 1.2 * r}, {-1.1 * r, 0.}};
    break;
  }
  std::string path;
  for (const auto &[dx, dy] : corners)
    path += (path.empty() ? "M" : "L") + coordinate(x + dx) + " " + coordinate(y + dy);
  return "<path" + kind + " d=\"" + path + "Z\"/>";
}

/// Whether one of the segments at point i is inside the window, or at least not entirely on one side of it.
bool is_near(const Chart &chart, const Curve &curve, std::size_t i)
{
  if (chart.x.shows(curve.x[i]))
    return true;
  const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, curve.x.size() - 1);
  const auto        all = [&](const auto &is_beside)
  { return is_beside(curve.x[before]) && is_beside(curve.x[i]) && is_beside(curve.x[after]); };
  return !all([&](double x) { return x < chart.x.begin; }) && !all([&](double x) { return x > chart.x.end; });
}

/// The line as an SVG path; long curves are reduced to at most four points per column of pixels, in their order.
std::string line_path(const Chart &chart, const Curve &curve, const Area &area)
{
  const auto drawn = [&](std::size_t i)
  { return chart.x.has_place(curve.x[i]) && chart.y.has_place(curve.y[i]) && is_near(chart, curve, i); };

  constexpr std::size_t long_curve = 2000; // points: two for each pixel and more
  const bool            is_long    = curve.x.size() > long_curve;
  std::string           path;
  bool                  pen_down = false;
  for (std::size_t i = 0; i < curve.x.size();)
  {
    if (!drawn(i))
    {
      pen_down = false;
      ++i;
      continue;
    }
    const double column = std::floor(area.x.at(curve.x[i]));
    std::size_t  last = i, low = i, high = i;
    const auto   in_column = [&](double x) { return x >= column && x < column + 1.; };
    for (std::size_t k = i; k < curve.x.size() && drawn(k) && (k == i || is_long) && in_column(area.x.at(curve.x[k]));
         ++k)
    {
      last = k;
      low  = curve.y[k] < curve.y[low] ? k : low;
      high = curve.y[k] > curve.y[high] ? k : high;
    }
    std::size_t previous = curve.x.size();
    for (const std::size_t k : {i, std::min(low, high), std::max(low, high), last})
      if (k != previous)
      {
        path += (pen_down ? "L" : "M") + coordinate(area.x.at(curve.x[k])) + " " + coordinate(area.y.at(curve.y[k]));
        pen_down = true;
        previous = k;
      }
    i = last + 1;
  }
  return path;
}

std::string lines(const Chart &chart, const Panel &panel, const Area &area)
{
  const double      width = area.right - area.left, height = area.bottom - area.top;
  const std::string clip = svg_box(area.left, area.top, width, height);
  std::string       svg  = "<svg" + clip + " viewBox=\"" + coordinate(area.left) + " " + coordinate(area.top) + " " +
                    coordinate(width) + " " + coordinate(height) + "\">\n";
  for (const Curve &curve : panel.curves)
    if (curve.line != LineStyle::none)
      svg += "<path class=\"" + line_class(curve) + "\" d=\"" + line_path(chart, curve, area) + "\"/>\n";
  return svg + "</svg>\n";
}

std::string markers(const Chart &chart, const Panel &panel, const Area &area)
{
  std::string svg;
  for (const Curve &curve : panel.curves)
    for (std::size_t i = 0; i < curve.x.size() && curve.marker != Marker::none; ++i)
    {
      if (!chart.x.shows(curve.x[i]) || !chart.y.shows(curve.y[i]))
        continue;
      const PointNote   note  = curve.notes.empty() ? PointNote() : curve.notes[i];
      const std::string shape = marker(curve, area.x.at(curve.x[i]), area.y.at(curve.y[i]), note.hollow);
      svg += note.text.empty() ? shape : svg_hint(note.text, shape);
    }
  return svg;
}

// Legend

struct LegendEntry
{
  const Curve *curve;
  double       x, y; ///< of its left end, from the legend's upper left corner
};

/// Entries in rows of a width, or one below the other with a gap wherever the colour changes.
std::vector<LegendEntry> legend_entries(const Chart &chart, const Panel &panel)
{
  const double             width = chart.width - left_margin - right_margin;
  std::vector<LegendEntry> entries;
  double                   x = 0., y = 0.;
  for (const Curve &curve : panel.curves)
  {
    if (curve.name.empty())
      continue;
    constexpr double letter_width = 6.5; // of the 12 px letters, on average
    const double     length       = 37. + letter_width * static_cast<double>(n_letters(curve.name));
    if (chart.legend_column > 0. && !entries.empty())
      y += legend_row + (entries.back().curve->colour == curve.colour ? 0. : 8.);
    else if (x > 0. && x + length - 8. > width)
    {
      x = 0.;
      y += legend_row;
    }
    entries.push_back({&curve, x, y});
    x += chart.legend_column > 0. ? 0. : length;
  }
  return entries;
}

std::string legend(const Chart &chart, const Panel &panel, double x0, double y0)
{
  std::string svg;
  for (const auto &[curve, x, y] : legend_entries(chart, panel))
  {
    const double left = x0 + x, middle = y0 + y + 9.;
    if (curve->line != LineStyle::none)
      svg += svg_line(line_class(*curve), left, middle, left + 20., middle);
    svg += marker(*curve, left + 10., middle, false) + svg_text(left + 25., middle + 4., curve->name, "label");
  }
  return svg;
}

// Panels

/// Heights above the drawing area, equal for all panels so that they are aligned.
struct Heights
{
  double title = 0., legend = 0., numbers = 8.;

  double above() const { return title + legend + numbers; }
};

Heights heights_of(const Chart &chart)
{
  Heights heights;
  for (const Panel &panel : chart.panels)
  {
    heights.title      = panel.title.empty() ? heights.title : panel_title_height;
    const auto entries = legend_entries(chart, panel);
    if (chart.legend_column == 0. && !entries.empty())
      heights.legend = std::max(heights.legend, entries.back().y + legend_row);
  }
  if (std::any_of(chart.marks.begin(), chart.marks.end(), [](const Mark &mark) { return mark.number > 0; }))
    heights.numbers = 18.;
  return heights;
}

/// A panel with its upper left corner at (x0, y0).
std::string panel_svg(const Chart &chart, const Panel &panel, const Heights &heights, double x0, double y0)
{
  const double left = x0 + left_margin, right = x0 + chart.width - right_margin;
  const double top = y0 + heights.above(), bottom = top + chart.height - bottom_margin;
  const Area   area{left, right, top, bottom, AxisMap(chart.x, left, right), AxisMap(chart.y, bottom, top)};

  return svg_text(left, y0 + 13., panel.title, "title") + shades(chart, area) + axes(chart, area) +
         tiles(panel, chart, area) + marks(chart, area) + levels(chart, area) + lines(chart, panel, area) +
         markers(chart, panel, area) +
         (chart.legend_column > 0. ? legend(chart, panel, right + 22., top)
                                   : legend(chart, panel, left, y0 + heights.title));
}

} // namespace

Curve rings(const std::string &name, int colour)
{
  return {name, {}, {}, colour, LineStyle::none, Marker::ring};
}

Curve tile_name(const std::string &name, int colour)
{
  return {name, {}, {}, colour, LineStyle::none, Marker::square};
}

void Panel::add(Curve curve)
{
  curve.colour = static_cast<int>(curves.size());
  curve.line   = curves.size() % 2 == 0 ? LineStyle::full : LineStyle::dashed;
  curves.push_back(std::move(curve));
}

std::string chart_svg(const Chart &described)
{
  for (const Panel &panel : described.panels)
    for (const Curve &curve : panel.curves)
      if (curve.x.size() != curve.y.size())
        throw std::invalid_argument("chart \"" + described.title + "\": curve \"" + curve.name + "\" has " +
                                    std::to_string(curve.x.size()) + " abscissae and " +
                                    std::to_string(curve.y.size()) + " values; give one value per abscissa.");

  const Chart   chart   = with_axes(described);
  const Heights heights = heights_of(described);
  const int     n = static_cast<int>(described.panels.size()), columns = std::min(chart.columns, n);
  const int     rows  = (n + columns - 1) / columns;
  const double  head  = title_height + (chart.note.empty() ? 0. : note_height);
  const double  width = chart.width + chart.legend_column, height = heights.above() + chart.height;

  std::string svg = svg_head(columns * width, head + rows * height, chart.title) +
                    svg_text(left_margin, 19., chart.title, "title") + svg_text(left_margin, 37., chart.note, "small");
  for (int i = 0; i < n; ++i)
    svg += panel_svg(chart, described.panels[i], heights, (i % columns) * width, head + (i / columns) * height);
  return in_page_language(svg + "</svg>\n");
}

} // namespace gestell::apps

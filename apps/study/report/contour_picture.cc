#include "apps/study/report/contour_picture.h"

#include "apps/output/text/svg.h"
#include "apps/study/report/shown_axis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gestell::apps
{
namespace
{

constexpr double contour_left = 66., contour_top = 30., contour_side = 260., contour_width = 340.,
                 contour_height = 340.;
constexpr int contour_cells     = 52; ///< along a side: five pixels each

struct Point2
{
  double x, y;
};

double distance(const Point2 &a, const Point2 &b)
{
  return std::hypot(a.x - b.x, a.y - b.y);
}

using Segments = std::vector<std::array<Point2, 2>>;

/// The picture's values at the corners of its cells, [second][first].
struct ContourGrid
{
  Eigen::MatrixXd values{contour_cells + 1, contour_cells + 1};

  static double coded(int i) { return -1. + 2. * i / contour_cells; }
  static double x(double i) { return contour_left + contour_side * i / contour_cells; }
  static double y(double j) { return contour_top + contour_side * (1. - j / contour_cells); }
};

ContourGrid grid_of(const ResponseSurface &surface, const SurfaceCut &cut, const ShownAxis &axis)
{
  ContourGrid     grid;
  Eigen::VectorXd xi = cut.at;
  for (int j = 0; j <= contour_cells; ++j)
    for (int i = 0; i <= contour_cells; ++i)
    {
      xi(cut.first)     = ContourGrid::coded(i);
      xi(cut.second)    = ContourGrid::coded(j);
      grid.values(j, i) = axis.shown(surface.value(xi));
    }
  return grid;
}

std::size_t band_at(const std::vector<double> &levels, double value)
{
  return static_cast<std::size_t>(std::upper_bound(levels.begin(), levels.end(), value) - levels.begin());
}

/// Stretches of rows between two levels, a path for each band between levels.
class Bands
{
public:
  explicit Bands(std::size_t n) : paths_(n) {}

  void add(std::size_t band, double from, double to, double y, double height)
  {
    if (to - from > 0.05)
      paths_[band] += "M" + coordinate(from) + " " + coordinate(y) + "h" + coordinate(to - from) + "v" +
                      coordinate(height) + "h" + coordinate(from - to) + "z";
  }

  std::string svg() const
  {
    std::string svg = "<g class=\"f0\" shape-rendering=\"crispEdges\">\n";
    for (std::size_t band = 0; band < paths_.size(); ++band)
      if (!paths_[band].empty())
        svg += "<path fill-opacity=\"" + short_text(opacity(band), 2) + "\" d=\"" + paths_[band] + "\"/>\n";
    return svg + "</g>\n";
  }

private:
  double opacity(std::size_t band) const
  {
    constexpr double lightest = 0.04; // opacity: a band is seen beside the paper
    constexpr double darkest  = 0.62; // opacity: lines and rings are seen upon it
    return lightest + darkest * static_cast<double>(band) / static_cast<double>(paths_.size());
  }

  std::vector<std::string> paths_;
};

/// Shades rows of half cells, cut where the value passes a level.
std::string shading(const ContourGrid &grid, const std::vector<double> &levels)
{
  Bands        bands(levels.size() + 1);
  const double height = 0.5 * contour_side / contour_cells;
  for (int half = 0; half < 2 * contour_cells; ++half)
  {
    const double          j = 0.5 * half + 0.25, share = j - std::floor(j), y = ContourGrid::y(0.5 * (half + 1));
    const Eigen::VectorXd row = (1. - share) * grid.values.row(static_cast<int>(j)).transpose() +
                                share * grid.values.row(static_cast<int>(j) + 1).transpose();
    double      from = 0.;
    std::size_t band = band_at(levels, row(0));
    const auto  end  = [&](double to)
    {
      bands.add(band, ContourGrid::x(from), ContourGrid::x(to), y, height);
      from = to;
    };
    for (int i = 0; i < contour_cells; ++i)
      for (std::size_t next = band_at(levels, row(i + 1)); band != next; band < next ? ++band : --band)
        end(i + (levels[band < next ? band : band - 1] - row(i)) / (row(i + 1) - row(i)));
    end(contour_cells);
  }
  return bands.svg();
}

/// Where a level passes the edge from a to b; both sides in units of cells.
Point2 crossing(const Point2 &a, double value_a, const Point2 &b, double value_b, double level)
{
  const double share = (level - value_a) / (value_b - value_a);
  return {ContourGrid::x(a.x + share * (b.x - a.x)), ContourGrid::y(a.y + share * (b.y - a.y))};
}

/// The line of a level, cell by cell; in a saddle the two pieces that the first corners make.
Segments level_line(const ContourGrid &grid, double level)
{
  Segments segments;
  for (int j = 0; j < contour_cells; ++j)
    for (int i = 0; i < contour_cells; ++i)
    {
      const std::array<Point2, 4> corners = {{{i + 0., j + 0.}, {i + 1., j + 0.}, {i + 1., j + 1.}, {i + 0., j + 1.}}};
      std::vector<Point2>         ends;
      for (int edge = 0; edge < 4; ++edge)
      {
        const Point2 &a = corners[edge], &b = corners[(edge + 1) % 4];
        const double  value_a = grid.values(static_cast<int>(a.y), static_cast<int>(a.x)),
                     value_b  = grid.values(static_cast<int>(b.y), static_cast<int>(b.x));
        if ((value_a < level) != (value_b < level))
          ends.push_back(crossing(a, value_a, b, value_b, level));
      }
      for (std::size_t n = 0; n + 1 < ends.size(); n += 2)
        segments.push_back({ends[n], ends[n + 1]});
    }
  return segments;
}

/// Places a name far from those before it and from the edges.
Point2 label_place(const Segments &segments, std::vector<Point2> &placed)
{
  Point2 best{-1., -1.};
  double widest = 0.;
  for (const auto &[a, b] : segments)
  {
    const Point2 middle{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    double       room = 2. * std::min({middle.x - contour_left, contour_left + contour_side - middle.x,
                                       middle.y - contour_top, contour_top + contour_side - middle.y});
    for (const Point2 &other : placed)
      room = std::min(room, distance(middle, other));
    if (room > widest)
    {
      widest = room;
      best   = middle;
    }
  }
  if (widest < 26.)
    return {-1., -1.};
  placed.push_back(best);
  return best;
}

std::string halo_text(const Point2 &at, const std::string &text)
{
  return "<text class=\"tick\" text-anchor=\"middle\" style=\"paint-order:stroke;stroke:var(--paper);stroke-width:3px;"
         "stroke-linejoin:round\" x=\"" +
         coordinate(at.x) + "\" y=\"" + coordinate(at.y + 4.) + "\">" + escape_xml(text) + "</text>\n";
}

std::string contour_lines(const ContourGrid &grid, const std::vector<double> &levels)
{
  std::string         svg, names;
  std::vector<Point2> placed;
  for (const double level : levels)
  {
    const Segments segments = level_line(grid, level);
    std::string    path;
    for (const auto &[a, b] : segments)
      path += "M" + coordinate(a.x) + " " + coordinate(a.y) + "L" + coordinate(b.x) + " " + coordinate(b.y);
    if (path.empty())
      continue;
    svg += "<path class=\"line s0\" d=\"" + path + "\"/>\n";
    if (const Point2 at = label_place(segments, placed); at.x >= 0.)
      names += halo_text(at, short_text(level, 6));
  }
  return svg + names;
}

std::string frame_svg(const std::vector<StudyVariable> &variables, const SurfaceCut &cut)
{
  const StudyVariable &a = variables[cut.first], &b = variables[cut.second];
  const ChartAxis      x = chart_axis(shown_axis(a), a.from, a.to), y = chart_axis(shown_axis(b), b.from, b.to);
  const AxisMap across(x, contour_left, contour_left + contour_side), up(y, contour_top + contour_side, contour_top);
  const double  right = contour_left + contour_side, bottom = contour_top + contour_side;
  std::string   svg = "<rect class=\"axis\"" + svg_box(contour_left, contour_top, contour_side, contour_side) + "/>\n";
  for (const Tick &tick : ticks_of(x, 4))
    svg += svg_line("axis", across.at(tick.value), bottom, across.at(tick.value), bottom + 4.) +
           svg_text(across.at(tick.value), bottom + 17., tick.text, "tick", "middle");
  for (const Tick &tick : ticks_of(y, 5))
    svg += svg_line("axis", contour_left - 4., up.at(tick.value), contour_left, up.at(tick.value)) +
           svg_text(contour_left - 7., up.at(tick.value) + 4., tick.text, "tick", "end");
  return svg + svg_text(0.5 * (contour_left + right), bottom + 36., x.label, "label", "middle") +
         svg_text(contour_left - 50., 0.5 * (contour_top + bottom), y.label, "label", "middle", -90.);
}

std::string marks_svg(const Eigen::MatrixXd &runs, const SurfaceCut &cut)
{
  const auto            x = [](double xi) { return ContourGrid::x(0.5 * (xi + 1.) * contour_cells); };
  const auto            y = [](double xi) { return ContourGrid::y(0.5 * (xi + 1.) * contour_cells); };
  std::string           svg;
  Eigen::Index          n          = 0;
  constexpr std::size_t most_rings = 80; // runs of a picture that stay apart
  for (Eigen::Index run = 0; run < runs.rows() && n < static_cast<Eigen::Index>(most_rings); ++run)
    if (std::max(std::abs(runs(run, cut.first)), std::abs(runs(run, cut.second))) <= 1. + same_level)
    {
      svg += "<circle class=\"line s5\" cx=\"" + coordinate(x(runs(run, cut.first))) + "\" cy=\"" +
             coordinate(y(runs(run, cut.second))) + "\" r=\"3\"/>";
      ++n;
    }
  if (cut.at_optimum)
    svg += svg_hint("optimum", "<path class=\"f1\" style=\"stroke:var(--paper)\" d=\"M" +
                                   coordinate(x(cut.at(cut.first))) + " " + coordinate(y(cut.at(cut.second)) - 7.) +
                                   "l6 7l-6 7l-6 -7Z\"/>");
  return svg;
}

} // namespace

std::string contour_picture(const ResponseSurface &surface, const std::vector<StudyVariable> &variables,
                            const Eigen::MatrixXd &coded_runs, const SurfaceCut &cut)
{
  const ShownAxis           axis = shown_axis(surface.output, magnitude_of(surface.computed));
  const ContourGrid         grid = grid_of(surface, cut, axis);
  const double              low = grid.values.minCoeff(), high = grid.values.maxCoeff();
  constexpr double          flat          = 1e-9; // of the values: below it they differ by rounding
  const bool                varies        = high - low > flat * std::max(std::abs(low), std::abs(high));
  constexpr int             contour_count = 7; // levels, about: lines stay apart
  const std::vector<double> levels        = varies ? nice_ticks(low, high, contour_count) : std::vector<double>();
  const std::string         title         = axis.head();
  return svg_head(contour_width, contour_height,
                  title + " over " + variables[cut.first].name + " and " + variables[cut.second].name) +
         svg_text(contour_left, 19., varies ? title : title + ": does not change", "title") + shading(grid, levels) +
         contour_lines(grid, levels) + frame_svg(variables, cut) + marks_svg(coded_runs, cut) + "</svg>\n";
}

} // namespace gestell::apps

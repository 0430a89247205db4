#pragma once

#include "apps/output/charts/chart_axis.h"

#include <string>
#include <vector>

namespace gestell::apps
{

enum class LineStyle
{
  full,
  dashed,
  dotted,
  dash_dotted,
  short_dashed,
  long_dashed,
  none
};

/// What is drawn at the points of a curve.
enum class Marker
{
  disc,
  square,
  triangle,
  diamond,
  ring,
  none
};

/// What a browser shows of a point of a curve, and how its marker is drawn.
struct PointNote
{
  std::string text;           ///< shown by browsers under the pointer
  bool        hollow = false; ///< the marker is not filled
};

struct Curve
{
  std::string            name{};     ///< empty: not in the legend
  std::vector<double>    x{}, y{};   ///< nan, and on a logarithmic axis what is not positive, interrupts the line
  int                    colour = 0; ///< of the classes s0..s6, repeated
  LineStyle              line   = LineStyle::full;
  Marker                 marker = Marker::none;
  std::vector<PointNote> notes{}; ///< one per point, or none

  void add(double at, double value)
  {
    x.push_back(at);
    y.push_back(value);
  }
};

/// A curve of rings without a line.
Curve rings(const std::string &name, int colour);

/// What stands in the legend for tiles of a colour.
Curve tile_name(const std::string &name, int colour);

/// An abscissa worth looking at: a dotted line with its number above it, or without one a tick at the bottom.
struct Mark
{
  double      x;
  std::string text; ///< shown by browsers under the pointer
  int         number = 0;
  int         colour = 0; ///< of the tick
};

/// A dotted horizontal line with its name at the right end.
struct Level
{
  double      y;
  std::string name;
};

/// Ordinates between which the paper is shaded.
struct Shade
{
  double begin, end;
  int    colour;
};

/// A filled rectangle below the curves: a bar, or a cell of a map.  Axes are not stretched for it.
struct Tile
{
  double      x_begin, x_end, y_begin, y_end;
  int         colour;
  std::string text{}; ///< shown by browsers under the pointer
};

/// Curves that share a drawing area.
struct Panel
{
  std::string        title;
  std::vector<Curve> curves;
  std::vector<Tile>  tiles{};

  /// Adds a curve told from those before it: by the next colour, every other one dashed.
  void add(Curve curve);
};

/// Curves in panels that share their axes; what leaves the window is cut off.
struct Chart
{
  std::string        title, note{}; ///< the note stands below the title
  ChartAxis          x{}, y{};
  std::vector<Panel> panels{Panel()};
  std::vector<Mark>  marks{};
  std::vector<Level> levels{};
  std::vector<Shade> shades{};
  double             width = 640., height = 280.; ///< of a panel with its axes, without titles and legend
  int                columns       = 1;           ///< of panels
  double             legend_column = 0.;          ///< width of a legend beside the panel; 0: rows above it
};

/// The chart as a stand-alone SVG document.  Long curves are thinned to the first, smallest, largest and last value of
/// each column of pixels, so that no peak is lost.
/// @throws std::invalid_argument if x and y of a curve differ in length, or an axis is empty.
std::string chart_svg(const Chart &chart);

} // namespace gestell::apps

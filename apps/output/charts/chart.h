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

/// Marker of the points of a curve.
enum class Marker
{
  disc,
  square,
  triangle,
  diamond,
  ring,
  none
};

/// Tooltip of a point of a curve, and the style of its marker.
struct PointNote
{
  std::string text;           ///< tooltip
  bool        hollow = false; ///< the marker is not filled
};

struct Curve
{
  std::string            name{};     ///< empty: omitted from the legend
  std::vector<double>    x{}, y{};   ///< nan, and on a logarithmic axis a value <= 0, interrupts the line
  int                    colour = 0; ///< class s0..s6, modulo their number
  LineStyle              line   = LineStyle::full;
  Marker                 marker = Marker::none;
  std::vector<PointNote> notes{}; ///< one per point, or none

  void add(double at, double value)
  {
    x.push_back(at);
    y.push_back(value);
  }
};

/// A curve of circle markers without a line.
Curve rings(const std::string &name, int colour);

/// Legend entry for the tiles of a colour.
Curve tile_name(const std::string &name, int colour);

/// A marked abscissa: a dotted line with its label above it, or without a label a tick at the bottom.
struct Mark
{
  double      x;
  std::string text; ///< tooltip
  int         number = 0;
  int         colour = 0; ///< of the tick
};

/// A dotted horizontal line with its name at the right end.
struct Level
{
  double      y;
  std::string name;
};

/// A shaded band between two ordinates.
struct Shade
{
  double begin, end;
  int    colour;
};

/// A filled rectangle below the curves: a bar, or a cell of a map.  The axis limits ignore tiles.
struct Tile
{
  double      x_begin, x_end, y_begin, y_end;
  int         colour;
  std::string text{}; ///< tooltip
};

/// Curves that share a drawing area.
struct Panel
{
  std::string        title;
  std::vector<Curve> curves;
  std::vector<Tile>  tiles{};

  /// Adds a curve in the next colour; every other curve is dashed.
  void add(Curve curve);
};

/// Curves in panels that share their axes; curves are clipped to the window.
struct Chart
{
  std::string        title, note{}; ///< the note is printed below the title
  ChartAxis          x{}, y{};
  std::vector<Panel> panels{Panel()};
  std::vector<Mark>  marks{};
  std::vector<Level> levels{};
  std::vector<Shade> shades{};
  double             width = 640., height = 280.; ///< of a panel with its axes, without titles and legend
  int                columns       = 1;           ///< of panels
  double             legend_column = 0.;          ///< width of a legend next to the panel; 0: rows above it
};

/// The chart as a stand-alone SVG document.  Long curves are thinned to the first, smallest, largest and last value of
/// each column of pixels, so that no peak is lost.
/// @throws std::invalid_argument if x and y of a curve differ in length, or an axis is empty.
std::string chart_svg(const Chart &chart);

} // namespace gestell::apps

#pragma once

#include <limits>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Multiples of 1, 2 or 5 times a power of ten in [low, high], about `count` of them.
std::vector<double> nice_ticks(double low, double high, int count);

struct Series
{
  std::string         name;
  std::vector<double> y; ///< one per abscissa; nan interrupts the line
};

/// A vertical line at an instant, with the number under which a table tells about it.
struct EventMark
{
  double      x;
  int         number;
  std::string text; ///< shown by browsers under the pointer
};

/// A horizontal line with its name at the right end.
struct Level
{
  double      y;
  std::string name;
};

/// A ring around a point worth looking at.
struct Ring
{
  double      x, y;
  std::string text; ///< shown by browsers under the pointer
};

/// Curves over one common abscissa, shown between x_begin and x_end (nan: all of it).
struct LineChart
{
  std::string            title, x_label, y_label;
  std::vector<double>    x; ///< ascending
  std::vector<Series>    series;
  std::vector<EventMark> marks;
  std::vector<double>    x_ticks{}; ///< empty: chosen
  std::vector<Level>     levels;
  std::vector<Ring>      rings;
  double                 x_begin = std::numeric_limits<double>::quiet_NaN();
  double                 x_end   = std::numeric_limits<double>::quiet_NaN();
  double                 y_begin = std::numeric_limits<double>::quiet_NaN(); ///< nan: as the curves need
  double                 y_end   = std::numeric_limits<double>::quiet_NaN();
  double                 width = 880., height = 340.;
};

/// The chart as a stand-alone SVG document.  Long series are thinned to the first, smallest, largest and last value of
/// each column of pixels, so no peak is lost.
/// @throws std::invalid_argument if a series is not as long as x.
std::string line_chart_svg(const LineChart &chart);

struct Bar
{
  std::string name;
  double      value;
  int         colour; ///< of the classes s0..s6
};

/// Horizontal bars about zero, one below the other, each with its name and value.
struct BarChart
{
  std::string      title, note;
  std::vector<Bar> bars;
  double           width = 420.;
};
std::string bar_chart_svg(const BarChart &chart);

} // namespace gestell::apps

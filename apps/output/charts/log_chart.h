#pragma once

#include <limits>
#include <string>
#include <vector>

namespace gestell::apps
{

struct LogCurve
{
  std::string         name; ///< empty: not in the legend
  std::vector<double> x, y; ///< nan, and on a logarithmic scale what is not positive, interrupts the line
  int                 colour = 0;
  bool                dashed = false;
  bool                points = false; ///< rings instead of a line
};

/// A tick on the abscissa of every panel.
struct LogMark
{
  double      x;
  std::string text; ///< shown by browsers under the pointer
  int         colour = 0;
};

struct LogPanel
{
  std::string           title;
  std::vector<LogCurve> curves;
};

/// Curves over a logarithmic abscissa, in panels that share their axes; what leaves the window is cut off.
struct LogChart
{
  std::string           title, x_label, y_label;
  double                x_begin = 1., x_end = 10., y_begin = 0., y_end = 1.;
  bool                  log_y = false;
  double                limit = std::numeric_limits<double>::quiet_NaN(); ///< a line, above which the paper is shaded
  std::vector<LogPanel> panels;
  std::vector<LogMark>  marks;
  int                   columns     = 2;
  double                panel_width = 440., panel_height = 250.; ///< of the drawing area with its axes
};

/// @throws std::invalid_argument if a curve's x and y differ in length or an axis is empty.
std::string log_chart_svg(const LogChart &chart);

} // namespace gestell::apps

#pragma once

#include "apps/output/charts/chart.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// How a chart takes part in what is done to others.
enum class ChartLink
{
  none,
  time,  ///< zoomed with all others over the time, cursor shared
  cursor ///< the cursor alone: it shows a part of the time
};

/**
 * Rows of curves over a shared abscissa that show all that can be seen of them: of each of `n_buckets` equal stretches
 * the first row and those in which a curve is smallest or largest, and the rows beside every mark.  The last row stays.
 *
 * @param x  ascending
 */
std::vector<std::size_t> telling_rows(const std::vector<double> &x, const std::vector<Curve> &curves,
                                      const std::vector<Mark> &marks, std::size_t n_buckets);

/// A figure whose picture a script replaces by a chart to zoom, pan and read; on paper and without script it stays.
/// Charts of several panels, or with tiles, stay pictures.
std::string live_figure(const Chart &chart, const std::string &svg, ChartLink link = ChartLink::none,
                        const std::string &caption = "");

/// The same of a page with many: on paper and without script a line names the file `name`.svg in charts/.  A figure
/// with its picture must stand on the page, too: the colours are read from there.
std::string live_figure_of_file(const Chart &chart, const std::string &svg, const std::string &name,
                                ChartLink link = ChartLink::none);

} // namespace gestell::apps

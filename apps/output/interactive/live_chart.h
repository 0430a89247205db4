#pragma once

#include "apps/output/charts/chart.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Which interactions a chart shares with others.
enum class ChartLink
{
  none,
  time,  ///< zoom over the time and cursor shared with all others
  cursor ///< only the cursor shared: the chart shows a part of the time
};

/**
 * Selects rows of curves over a shared abscissa so that the drawn curves look the same. Selected are, for each of
 * `n_buckets` equal intervals, the first row and the rows in which a curve is smallest or largest, the rows next to
 * every mark, and the last row.
 *
 * @param x  ascending
 */
std::vector<std::size_t> telling_rows(const std::vector<double> &x, const std::vector<Curve> &curves,
                                      const std::vector<Mark> &marks, std::size_t n_buckets);

/// A figure whose SVG is replaced by a script with an interactive chart (zoom, pan, cursor); print and pages without
/// scripts show the SVG.  Charts of several panels, or with tiles, remain SVG.
std::string live_figure(const Chart &chart, const std::string &svg, ChartLink link = ChartLink::none,
                        const std::string &caption = "");

/// The same for a page with many charts: in print and without scripts a line gives the file charts/`name`.svg instead.
/// At least one figure with its SVG must be on the page, because the colours are read from there.
std::string live_figure_of_file(const Chart &chart, const std::string &svg, const std::string &name,
                                ChartLink link = ChartLink::none);

} // namespace gestell::apps

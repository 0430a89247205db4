#include "apps/output/interactive/live_chart.h"

#include "apps/output/interactive/page_scripts.h"
#include "apps/output/text/base64.h"
#include "apps/output/text/html.h"
#include "apps/output/text/json.h"
#include "apps/output/text/svg.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

/// Part of the axis, with the rows just outside of it.
std::pair<std::size_t, std::size_t> window_of(const ChartAxis &axis, const std::vector<double> &x)
{
  std::size_t first = 0, last = x.size();
  while (first + 1 < last && x[first + 1] < axis.begin) // false if it has no start
    ++first;
  while (last > first + 1 && x[last - 2] > axis.end)
    --last;
  return {first, last};
}

std::vector<float> chosen(const std::vector<double> &values, const std::vector<std::size_t> &rows, std::size_t first)
{
  std::vector<float> few;
  for (const std::size_t i : rows)
    few.push_back(static_cast<float>(values[first + i]));
  return few;
}

bool share_abscissa(const std::vector<Curve> &curves)
{
  return std::all_of(curves.begin(), curves.end(), [&](const Curve &curve) { return curve.x == curves.front().x; });
}

bool ascending(const std::vector<double> &x)
{
  return std::is_sorted(x.begin(), x.end());
}

std::vector<double> part(const std::vector<double> &values, std::size_t first, std::size_t last)
{
  return {values.begin() + static_cast<long>(first), values.begin() + static_cast<long>(last)};
}

Json curve_json(const Curve &curve)
{
  return {{"name", curve.name},
          {"colour", curve.colour},
          {"line", curve.line == LineStyle::none ? -1 : static_cast<int>(curve.line)},
          {"points", curve.marker != Marker::none}};
}

/// Abscissa once and few rows, or each curve with its own.
void add_curves(Json &data, const Chart &chart)
{
  const std::vector<Curve> &curves = chart.panels[0].curves;
  if (!share_abscissa(curves))
  {
    for (const Curve &curve : curves)
    {
      Json one = curve_json(curve);
      one["x"] = base64(std::vector<float>(curve.x.begin(), curve.x.end()));
      one["y"] = base64(std::vector<float>(curve.y.begin(), curve.y.end()));
      data["curves"].push_back(one);
    }
    return;
  }
  const auto [first, last] = window_of(chart.x, curves.front().x);
  std::vector<Curve> seen;
  for (const Curve &curve : curves)
    seen.push_back({"", {}, part(curve.y, first, last)});
  const std::vector<double> x              = part(curves.front().x, first, last);
  constexpr std::size_t     most_rows      = 2000; // of all curves: two for each pixel of a chart
  constexpr std::size_t     fewest_buckets = 250;  // for each curve, for any number of curves
  const std::size_t         buckets        = std::max(fewest_buckets, most_rows / (2 * curves.size() + 1));
  const auto                rows           = telling_rows(x, seen, chart.marks, buckets);
  data["x"]                                = base64(chosen(curves.front().x, rows, first));
  for (const Curve &curve : curves)
  {
    Json one = curve_json(curve);
    one["y"] = base64(chosen(curve.y, rows, first));
    data["curves"].push_back(one);
  }
}

bool can_live(const Chart &chart)
{
  if (page_libraries().empty() || chart.panels.size() != 1 || !chart.panels[0].tiles.empty())
    return false;
  const std::vector<Curve> &curves = chart.panels[0].curves;
  return std::any_of(curves.begin(), curves.end(), [](const Curve &curve) { return !curve.x.empty(); }) &&
         std::all_of(curves.begin(), curves.end(), [](const Curve &curve) { return ascending(curve.x); });
}

/// Rows from first to before last with the smallest and largest y; values that are not numbers are skipped.
std::pair<std::size_t, std::size_t> extremes(const std::vector<double> &y, std::size_t first, std::size_t last)
{
  std::size_t low = first, high = first;
  for (std::size_t i = first; i < last; ++i)
  {
    if (!(y[i] >= y[low])) // it is smaller, or one of them is not a number
      low = std::isnan(y[i]) ? low : i;
    if (!(y[i] <= y[high]))
      high = std::isnan(y[i]) ? high : i;
  }
  return {low, high};
}

Json number(double x)
{
  return std::isnan(x) ? Json() : Json(x);
}

std::string data_element(const Chart &chart, ChartLink link)
{
  Json data = {{"title", chart.title},
               {"note", chart.note},
               {"link", link == ChartLink::time     ? "time"
                        : link == ChartLink::cursor ? "cursor"
                                                    : ""},
               {"height", chart.height},
               {"x_label", chart.x.label},
               {"y_label", chart.y.label},
               {"x_window", {number(chart.x.begin), number(chart.x.end)}},
               {"y_window", {number(chart.y.begin), number(chart.y.end)}},
               {"logarithmic", {chart.x.scale == Scale::logarithmic, chart.y.scale == Scale::logarithmic}},
               {"curves", Json::array()},
               {"marks", Json::array()},
               {"levels", Json::array()}};
  add_curves(data, chart);
  for (const Mark &mark : chart.marks)
    data["marks"].push_back({mark.x, mark.text, mark.number, mark.colour});
  for (const Level &level : chart.levels)
    data["levels"].push_back({level.y, level.name});
  const std::string json = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  return "<script type=\"application/json\">" + inside_script(json) + "</script>";
}

} // namespace

std::vector<std::size_t> telling_rows(const std::vector<double> &x, const std::vector<Curve> &curves,
                                      const std::vector<Mark> &marks, std::size_t n_buckets)
{
  std::vector<std::size_t> rows;
  if (x.empty())
    return rows;
  const double width = (x.back() - x.front()) / static_cast<double>(n_buckets);
  for (std::size_t first = 0, bucket = 0; first < x.size(); ++bucket)
  {
    std::size_t last = first + 1;
    while (last < x.size() && x[last] < x.front() + static_cast<double>(bucket + 1) * width)
      ++last;
    rows.push_back(first);
    for (const Curve &curve : curves)
    {
      const auto [low, high] = extremes(curve.y, first, last);
      rows.insert(rows.end(), {low, high});
    }
    first = last;
  }
  for (const Mark &mark : marks)
  {
    const auto at = static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), mark.x) - x.begin());
    for (const std::size_t i : {at - 1, at, at + 1})
      if (i < x.size()) // 0 - 1 is large
        rows.push_back(i);
  }
  rows.push_back(x.size() - 1);
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

std::string live_figure(const Chart &chart, const std::string &svg, ChartLink link, const std::string &caption)
{
  if (!can_live(chart))
    return figure(svg, caption);
  return "<figure class=\"live\">" + svg + data_element(chart, link) +
         (caption.empty() ? "" : "<figcaption>" + caption + "</figcaption>") + "</figure>\n";
}

std::string live_figure_of_file(const Chart &chart, const std::string &svg, const std::string &name, ChartLink link)
{
  if (!can_live(chart))
    return figure(svg);
  return "<figure class=\"live\"><p class=\"soft still\">" + escape_xml(chart.title) + ": charts/" + escape_xml(name) +
         ".svg</p>" + data_element(chart, link) + "</figure>\n";
}

} // namespace gestell::apps

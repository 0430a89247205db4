#include "apps/output/charts/work_precision_chart.h"

#include "apps/output/charts/chart.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace gestell::apps
{
namespace
{

/// A time [s] in the unit in which it reads well.
std::string time_text(double x)
{
  const double unit = x < 0.99e-3 ? 1e6 : x < 0.99 ? 1e3 : 1.;
  return short_text(x * unit, 4) + (unit == 1. ? " s" : unit == 1e3 ? " ms" : " µs");
}

/// A method's line: its front over both treatments of events.
struct MethodLine
{
  std::string              method, family;
  std::vector<std::size_t> points;
  int                      style; ///< counts the methods of a family
};

/// Keeps of points in the order of their work those that are more accurate than all before them.
void keep_front(const WorkPrecision &chart, std::vector<std::size_t> &points)
{
  double best = std::numeric_limits<double>::infinity();
  points.erase(
      std::remove_if(points.begin(), points.end(),
                     [&](std::size_t i)
                     { return chart.points[i].error >= std::exchange(best, std::min(best, chart.points[i].error)); }),
      points.end());
}

std::vector<MethodLine> lines_of(const WorkPrecision &chart, int model, WorkMeasure measure)
{
  std::vector<MethodLine> lines;
  for (std::size_t i = 0; i < chart.points.size(); ++i)
  {
    const WorkPoint &point = chart.points[i];
    if (point.model != model || !point.failure.empty() || !std::isfinite(point.error) || !(point.error > 0.) ||
        point.error > 3. || !(work_of(point, measure) > 0.))
      continue;
    auto line = std::find_if(lines.begin(), lines.end(), [&](const MethodLine &l) { return l.method == point.method; });
    if (line == lines.end())
    {
      const auto style =
          std::count_if(lines.begin(), lines.end(), [&](const MethodLine &l) { return l.family == point.family; });
      line = lines.insert(lines.end(), {point.method, point.family, {}, int(style)});
    }
    line->points.push_back(i);
  }
  for (MethodLine &line : lines)
  {
    std::sort(line.points.begin(), line.points.end(),
              [&](std::size_t a, std::size_t b)
              { return work_of(chart.points[a], measure) < work_of(chart.points[b], measure); });
    keep_front(chart, line.points);
  }
  return lines;
}

Curve curve_of(const WorkPrecision &chart, const MethodLine &line, WorkMeasure measure)
{
  Curve curve{line.method,
              {},
              {},
              family_colour(line.family),
              static_cast<LineStyle>(line.style % 6),
              static_cast<Marker>(line.style % 4)};
  for (const std::size_t i : line.points)
  {
    const WorkPoint &point = chart.points[i];
    curve.add(work_of(point, measure), point.error);
    curve.notes.push_back(
        {point.method + ", " + setting_words(point) + (point.events ? ", events located" : ", events not located"),
         !point.resolved});
  }
  return curve;
}

} // namespace

double work_of(const WorkPoint &point, WorkMeasure measure)
{
  return measure == WorkMeasure::cpu ? point.cpu_s : double(std::max(point.work.evaluations, point.work.newton));
}

int family_colour(const std::string &family)
{
  static const std::array<const char *, 7> families = {"BDF", "Newmark", "exact", "CVODE", "IDA", "ARKODE", "PETSc"};
  // Blue, orange, green, purple, dark grey, sky blue; the ochre, near to orange, comes last.
  static const std::array<int, 7> colours = {0, 1, 2, 3, 5, 6, 4};
  for (std::size_t i = 0; i < families.size(); ++i)
    if (family == families[i])
      return colours[i];
  return 4;
}

std::string work_precision_svg(const WorkPrecision &work, int model, WorkMeasure measure)
{
  const WorkModel &size = work.models[model];
  Chart            chart{"Work and precision: " + work.scene + ", " + std::to_string(size.coordinates) + " DOFs"};
  chart.note = "Each line is the better of runs with and without event location; hollow: not resolved by the reference "
               "(error " +
               short_text(size.reference_error, 2) + ")";
  chart.x.scale = chart.y.scale = Scale::logarithmic;
  chart.x.label = measure == WorkMeasure::cpu ? "CPU time of stepping" : "evaluations of forces or right-hand sides";
  chart.x.tick_text = measure == WorkMeasure::cpu ? time_text : nullptr;
  chart.y.label     = "error (root mean square, scaled)";
  chart.shades      = {{0., 10. * size.reference_error, 5}};
  for (const MethodLine &line : lines_of(work, model, measure))
    chart.panels[0].curves.push_back(curve_of(work, line, measure));
  chart.width         = 710.;
  chart.height        = std::max(540., 20. * double(chart.panels[0].curves.size()));
  chart.legend_column = 290.;
  return chart_svg(chart);
}

} // namespace gestell::apps

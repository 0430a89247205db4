#include "apps/study/report/study_charts.h"

#include "apps/output/charts/chart.h"
#include "apps/study/report/shown_axis.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr std::size_t most_rings_of_runs = 400; ///< rings of a chart; runs.csv has all

double t_quantile(const ResponseSurface &surface)
{
  const int dof = surface.quality.n_runs - surface.quality.n_coefficients;
  return dof > 0 ? boost::math::quantile(boost::math::students_t(dof), 0.5 + 0.5 * surface.level)
                 : std::numeric_limits<double>::quiet_NaN();
}

/// y, and y -+ t s, along variable i through a point.
struct Slice
{
  Curve middle, low, high;
};

Slice slice_through(const ResponseSurface &surface, const ShownAxis &axis, Eigen::VectorXd xi, Eigen::Index i,
                    int colour)
{
  const double t = t_quantile(surface);
  Slice        slice;
  slice.middle.colour = slice.low.colour = slice.high.colour = colour;
  slice.low.line = slice.high.line = LineStyle::dotted;
  constexpr int slice_points       = 40; // of a curve of degree two or three
  for (int n = 0; n <= slice_points; ++n)
  {
    xi(i)          = -1. + 2. * n / slice_points;
    const double y = surface.value(xi), half = t * surface.standard_error(xi);
    slice.middle.add(xi(i), axis.shown(y));
    if (std::isfinite(half))
    {
      slice.low.add(xi(i), axis.shown(y - half));
      slice.high.add(xi(i), axis.shown(y + half));
    }
  }
  return slice;
}

void add_slice(Slice slice, const std::string &name, Panel &panel)
{
  slice.middle.name = name;
  panel.curves.push_back(slice.middle);
  panel.curves.push_back(slice.low);
  panel.curves.push_back(slice.high);
}

std::string range_text(const StudyVariable &variable)
{
  const ShownAxis axis = shown_axis(variable);
  return variable.name + ": " + axis.text(variable.from) + " to " + axis.text_with_unit(variable.to);
}

Curve diagonal(double low, double high)
{
  Curve line;
  line.colour = 5;
  line.line   = LineStyle::dotted;
  line.add(low, low);
  line.add(high, high);
  return line;
}

/// Dots of runs by two columns of outputs.
Curve dots_of(const StudyTable &table, const std::vector<int> &rows, const ShownAxis &x, int column_x,
              const ShownAxis &y, int column_y, const Curve &like)
{
  Curve             dots   = like;
  const std::size_t stride = rows.size() / most_rings_of_runs + 1;
  for (std::size_t i = 0; i < rows.size(); i += stride)
  {
    dots.add(x.shown(table.values(rows[i], column_x)), y.shown(table.values(rows[i], column_y)));
    dots.notes.push_back({"run " + std::to_string(rows[i] + 1)});
  }
  return dots;
}

std::vector<int> rows_on_front(const StudyTable &table, const std::vector<int> &rows, const OptimumTask &task)
{
  Eigen::MatrixXd    goals(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(task.goals.size()));
  std::vector<Sense> senses;
  for (std::size_t j = 0; j < task.goals.size(); ++j)
  {
    senses.push_back(task.goals[j].sense);
    for (std::size_t i = 0; i < rows.size(); ++i)
      goals(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = table.values(rows[i], task.goals[j].output);
  }
  std::vector<int> front;
  for (const int i : nondominated(goals, senses))
    front.push_back(rows[i]);
  return front;
}

std::string goal_head(const Goal &goal, const ShownAxis &axis)
{
  return axis.head() + (goal.sense == Sense::minimise ? ", to be minimised" : ", to be maximised");
}

} // namespace

std::string slices_chart(const ResponseSurface &surface, const std::vector<StudyVariable> &variables,
                         const Eigen::VectorXd *optimum)
{
  const ShownAxis axis = shown_axis(surface.output, magnitude_of(surface.computed));
  const auto      k    = static_cast<Eigen::Index>(variables.size());
  Chart           chart;
  chart.title   = axis.head() + " over one variable";
  chart.note    = "dotted: confidence interval of the fit, " + percent(surface.level);
  chart.x       = {"coded value", -1., 1.};
  chart.y.label = axis.head();
  chart.width   = 330.;
  chart.height  = 230.;
  chart.columns = 2;
  chart.panels.clear();
  for (Eigen::Index i = 0; i < k; ++i)
  {
    Panel panel{range_text(variables[i]), {}};
    add_slice(slice_through(surface, axis, Eigen::VectorXd::Zero(k), i, 0), optimum ? "others at the midpoint" : "",
              panel);
    if (optimum)
      add_slice(slice_through(surface, axis, *optimum, i, 1), "others at the optimum", panel);
    chart.panels.push_back(panel);
  }
  return chart_svg(chart);
}

std::string predicted_chart(const ResponseSurface &surface, const std::vector<int> &run_numbers)
{
  const ShownAxis axis = shown_axis(surface.output, magnitude_of(surface.computed));
  Curve fitted{"surface", {}, {}, 0, LineStyle::none, Marker::disc}, left_out = rings("surface of the other runs", 1);
  const auto stride =
      static_cast<Eigen::Index>(surface.computed.size() / static_cast<Eigen::Index>(most_rings_of_runs) + 1);
  for (Eigen::Index run = 0; run < surface.computed.size(); run += stride)
  {
    const double    computed = axis.shown(surface.computed(run));
    const PointNote note{"run " + std::to_string(run_numbers[static_cast<std::size_t>(run)] + 1)};
    fitted.add(computed, axis.shown(surface.fitted(run)));
    fitted.notes.push_back(note);
    if (!std::isfinite(surface.left_out(run)))
      continue;
    left_out.add(computed, axis.shown(surface.left_out(run)));
    left_out.notes.push_back(note);
  }
  Chart chart;
  chart.title                 = surface.output.name + ", predicted over computed values";
  chart.width                 = 400.;
  chart.height                = 340.;
  chart.x.label               = axis.head() + ", computed";
  chart.y.label               = axis.head() + ", predicted";
  chart.x                     = gestell::apps::fitted(chart.x, axis.shown(surface.computed.minCoeff()),
                                                      axis.shown(surface.computed.maxCoeff()), 0.06);
  chart.panels.front().curves = {diagonal(chart.x.begin, chart.x.end), left_out, fitted};
  return chart_svg(chart);
}

std::string pareto_chart(const StudyFindings &findings, int first_goal, int second_goal)
{
  const StudyTable      &table = findings.table;
  const std::vector<int> rows  = table.usable_runs();
  const Goal            &a = findings.front_task.goals.at(first_goal), &b = findings.front_task.goals.at(second_goal);
  const ShownAxis        x = shown_axis(table.outputs[a.output], magnitude_of(table.values.col(a.output)));
  const ShownAxis        y = shown_axis(table.outputs[b.output], magnitude_of(table.values.col(b.output)));
  Chart                  chart;
  chart.title   = table.outputs[b.output].name + " over " + table.outputs[a.output].name;
  chart.height  = 340.;
  chart.x.label = goal_head(a, x);
  chart.y.label = goal_head(b, y);
  Panel &panel  = chart.panels.front();
  panel.curves.push_back(dots_of(table, rows, x, a.output, y, b.output, rings("runs", 5)));
  panel.curves.push_back(dots_of(table, rows_on_front(table, rows, findings.front_task), x, a.output, y, b.output,
                                 {"non-dominated runs", {}, {}, 0, LineStyle::none, Marker::disc}));
  Curve front{"front on the surfaces", {}, {}, 1, LineStyle::full, Marker::triangle};
  if (findings.front_task.goals.size() > 2)
    front.line = LineStyle::none;
  for (const ParetoPoint &point : findings.front)
    front.add(x.shown(point.values(a.output)), y.shown(point.values(b.output)));
  if (!findings.front.empty())
    panel.curves.push_back(front);
  if (findings.optimum)
  {
    Curve                  optimum{"optimum", {}, {}, 2, LineStyle::none, Marker::diamond};
    const Eigen::VectorXd &values =
        findings.optimum->verified ? *findings.optimum->verified : findings.optimum->found.values;
    optimum.add(x.shown(values(a.output)), y.shown(values(b.output)));
    panel.curves.push_back(optimum);
  }
  const auto widen = [&](ChartAxis &axis, bool abscissa)
  {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Curve &curve : panel.curves)
      for (const double value : abscissa ? curve.x : curve.y)
      {
        low  = std::min(low, value);
        high = std::max(high, value);
      }
    axis = fitted(axis, low, high, 0.05);
  };
  widen(chart.x, true);
  widen(chart.y, false);
  return chart_svg(chart);
}

} // namespace gestell::apps

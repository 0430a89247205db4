#include "apps/study/report/scatter_matrix.h"

#include "apps/output/text/svg.h"
#include "apps/study/report/shown_axis.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr double scatter_cell = 92., scatter_gap = 6., scatter_edge = 10., scatter_head = 30.; ///< pixels

struct ScatterColumn
{
  ShownAxis       axis;
  Eigen::VectorXd values; ///< as shown
};

ScatterColumn scatter_column(const ShownAxis &axis, const Eigen::VectorXd &values)
{
  return {axis, axis.factor * values};
}

/// A column that is the same in all runs, or is empty, says nothing of the others.
bool tells_something(const Eigen::VectorXd &values)
{
  constexpr double rounding = 1e-9; ///< of the values
  return values.allFinite() && values.maxCoeff() - values.minCoeff() > rounding * values.cwiseAbs().maxCoeff();
}

/// Variables, then outputs; where they are too many, outputs have the better right.
std::vector<ScatterColumn> scatter_columns(const StudyTable &table)
{
  std::vector<ScatterColumn> columns, outputs;
  for (std::size_t j = 0; j < table.variables.size(); ++j)
    if (const Eigen::VectorXd levels = table.levels.col(Eigen::Index(j)); tells_something(levels))
      columns.push_back(scatter_column(shown_axis(table.variables[j]), levels));
  for (std::size_t j = 0; j < table.outputs.size() && outputs.size() < std::size_t(most_scatter_columns); ++j)
    if (const Eigen::VectorXd values = table.values.col(Eigen::Index(j)); tells_something(values))
      outputs.push_back(scatter_column(shown_axis(table.outputs[j], magnitude_of(values)), values));
  columns.resize(std::min(columns.size(), std::size_t(most_scatter_columns) - outputs.size()));
  columns.insert(columns.end(), outputs.begin(), outputs.end());
  return columns;
}

/// Pearson's coefficient; nan where a column is constant.
double correlation(const Eigen::VectorXd &a, const Eigen::VectorXd &b)
{
  const Eigen::ArrayXd da = a.array() - a.mean(), db = b.array() - b.mean();
  return (da * db).sum() / std::sqrt(da.square().sum() * db.square().sum());
}

struct ScatterCell
{
  double left, top;
};

ScatterCell cell_at(std::size_t row, std::size_t column)
{
  const double pitch = scatter_cell + scatter_gap;
  return {scatter_edge + pitch * static_cast<double>(column), scatter_head + pitch * static_cast<double>(row)};
}

std::string outline_svg(const ScatterCell &cell)
{
  return "<rect class=\"grid\"" + svg_box(cell.left, cell.top, scatter_cell, scatter_cell) + "/>";
}

/// Names longer than a cell are cut.
std::string fitting(const std::string &name)
{
  constexpr std::size_t most = 13; // letters above a picture 92 pixels wide
  return n_letters(name) <= most ? name : name.substr(0, most - 1) + "…";
}

std::string name_svg(const ScatterColumn &column, const ScatterCell &cell)
{
  const double middle = cell.left + 0.5 * scatter_cell, top = cell.top;
  return svg_text(middle, top + 34., fitting(column.axis.name), "label", "middle") +
         svg_text(middle, top + 51., column.axis.unit.empty() ? "" : "[" + column.axis.unit + "]", "small", "middle") +
         svg_text(middle, top + 72.,
                  short_text(column.values.minCoeff(), 3) + " … " + short_text(column.values.maxCoeff(), 3), "small",
                  "middle");
}

std::string correlation_svg(const ScatterColumn &a, const ScatterColumn &b, const ScatterCell &cell)
{
  const double      r    = correlation(a.values, b.values);
  const std::string text = std::isfinite(r) ? short_text(std::abs(r) < 5e-3 ? 0. : r, 2) : "–";
  return "<g opacity=\"" + short_text(std::isfinite(r) ? 0.35 + 0.65 * std::abs(r) : 0.35, 2) + "\">" +
         svg_text(cell.left + 0.5 * scatter_cell, cell.top + 0.5 * scatter_cell + 5., text,
                  std::abs(r) > 0.5 ? "title" : "label", "middle") +
         "</g>";
}

std::string dots_svg(const ScatterColumn &x, const ScatterColumn &y, const std::vector<int> &rows,
                     const std::vector<bool> &on_front, const ScatterCell &cell)
{
  constexpr double inset = 7.; // pixels
  const auto       range = [](const Eigen::VectorXd &values)
  { return fitted(ChartAxis(), values.minCoeff(), values.maxCoeff(), 0.); };
  const AxisMap across(range(x.values), cell.left + inset, cell.left + scatter_cell - inset);
  const AxisMap up(range(y.values), cell.top + scatter_cell - inset, cell.top + inset);
  std::string   svg;
  for (const bool front : {false, true})
    for (const int row : rows)
      if (on_front[row] == front)
        svg += std::string("<circle class=\"") + (front ? "f1" : "f0") + "\" opacity=\".7\" cx=\"" +
               coordinate(across.at(x.values(row))) + "\" cy=\"" + coordinate(up.at(y.values(row))) + "\" r=\"1.9\"/>";
  return svg;
}

/// Runs that are drawn: all of few, evenly chosen ones of many, always those of the front.
std::vector<int> drawn_rows(int n_runs, const std::vector<bool> &on_front)
{
  constexpr int    most_dots = 400; // of a picture of 92 pixels a side
  const int        stride    = (n_runs + most_dots - 1) / most_dots;
  std::vector<int> rows;
  for (int row = 0; row < n_runs; ++row)
    if (row % stride == 0 || on_front[row])
      rows.push_back(row);
  return rows;
}

} // namespace

std::string scatter_matrix(const StudyTable &usable, const std::vector<int> &front)
{
  const std::vector<ScatterColumn> columns = scatter_columns(usable);
  std::vector<bool>                on_front(usable.n_runs(), false);
  for (const int row : front)
    on_front[row] = true;
  const std::vector<int> rows = drawn_rows(usable.n_runs(), on_front);
  const ScatterCell      end  = cell_at(columns.size(), columns.size());

  std::string svg =
      svg_head(end.left + scatter_edge - scatter_gap, end.top + scatter_edge - scatter_gap, "Runs") +
      svg_text(scatter_edge, 19., count_text(usable.n_runs(), "run") + (front.empty() ? "" : ", orange: not dominated"),
               "title");
  for (std::size_t i = 0; i < columns.size(); ++i)
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
      const ScatterCell cell = cell_at(i, j);
      svg += outline_svg(cell) +
             (i == j  ? name_svg(columns[i], cell)
              : i < j ? correlation_svg(columns[i], columns[j], cell)
                      : dots_svg(columns[j], columns[i], rows, on_front, cell)) +
             "\n";
    }
  return svg + "</svg>\n";
}

} // namespace gestell::apps

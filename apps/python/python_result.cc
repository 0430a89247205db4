#include "apps/python/python_result.h"

#include "apps/analysis/analyses.h"
#include "apps/output/charts/signal_charts.h"
#include "apps/output/text/svg.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace gestell::python
{
namespace
{

namespace py = pybind11;

} // namespace

py::array read_only(const py::object &result, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                    const double *first)
{
  py::array view(py::dtype::of<double>(), std::move(shape), std::move(strides), first, result);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

namespace
{

py::ssize_t n_rows(const coupling::RunResult &run)
{
  return run.columns.empty() ? 0 : py::ssize_t(run.rows.size() / run.columns.size());
}

std::string peak_rows(const coupling::RunResult &run)
{
  std::ostringstream out;
  for (const coupling::SignalSummary &signal : run.signals)
    out << "<tr><th>" << apps::escape_xml(signal.name) << "</th><td>" << short_text(signal.min) << "</td><td>"
        << short_text(signal.t_min) << "</td><td>" << short_text(signal.max) << "</td><td>" << short_text(signal.t_max)
        << "</td><td>" << apps::escape_xml(signal.unit) << "</td></tr>";
  return out.str();
}

std::string mode_rows(const std::vector<coupling::Mode> &modes)
{
  std::ostringstream out;
  for (std::size_t i = 0; i < modes.size(); ++i)
    out << "<tr><th>" << i + 1 << "</th><td>" << short_text(modes[i].frequency_hz) << "</td><td>"
        << short_text(100. * modes[i].damping_ratio) << "</td></tr>";
  return out.str();
}

std::string run_text(const coupling::RunResult &run)
{
  std::string text = "<table><thead><tr><th>signal</th><th>min</th><th>at t [s]</th><th>max</th><th>at t [s]</th>"
                     "<th>unit</th></tr></thead><tbody>" +
                     peak_rows(run) + "</tbody></table><p>" + apps::escape_xml(run.method) + ", " +
                     count_text(run.events.size(), "event") + "</p>";
  if (n_rows(run) > 2)
  {
    const auto            charts      = apps::signal_charts(run);
    constexpr std::size_t most_charts = 2; // in a notebook; `report` has all
    for (std::size_t i = 0; i < std::min(most_charts, charts.size()); ++i)
      text += charts[i].svg;
  }
  return text;
}

} // namespace

const coupling::RunResult &PythonResult::run() const
{
  if (!result_.run)
    throw std::invalid_argument("no run: modes and frequency responses have no history; call scene.run()");
  return *result_.run;
}

const apps::Result &PythonResult::whole_result()
{
  const bool has_rows = result_.run && result_.run->rows.size() > result_.run->columns.size();
  if (result_.command == "run" && has_rows && !std::exchange(whole_, true))
    apps::add_answers(apps::analyses_of("run"), *session_, result_);
  return result_;
}

py::array history_view(const py::object &result)
{
  const auto &run     = result.cast<const PythonResult &>().run();
  const auto  columns = py::ssize_t(run.columns.size()), size = py::ssize_t(sizeof(double));
  return read_only(result, {n_rows(run), columns}, {columns * size, size}, run.rows.data());
}

py::array column_view(const py::object &result, const std::string &name)
{
  const auto &run   = result.cast<const PythonResult &>().run();
  const auto  found = std::find(run.columns.begin(), run.columns.end(), name);
  if (found == run.columns.end())
    throw std::invalid_argument("the run has no signal '" + name + "'" + suggestion(name, run.columns));
  const auto size = py::ssize_t(sizeof(double));
  return read_only(result, {n_rows(run)}, {py::ssize_t(run.columns.size()) * size},
                   run.rows.data() + (found - run.columns.begin()));
}

Eigen::MatrixXd shapes_of(const std::vector<coupling::Mode> &modes)
{
  Eigen::MatrixXd shapes(modes.empty() ? 0 : modes.front().shape.size(), Eigen::Index(modes.size()));
  for (std::size_t i = 0; i < modes.size(); ++i)
    shapes.col(Eigen::Index(i)) = modes[i].shape;
  return shapes;
}

std::string notebook_text(const PythonResult &result)
{
  const apps::Result &all  = result.result();
  std::string         text = "<div><strong>" + apps::escape_xml(all.scene) + "</strong>";
  if (all.run)
    text += run_text(*all.run);
  if (!all.run && !all.coupled_modes.empty())
    text += "<table><thead><tr><th>mode</th><th>frequency [Hz]</th><th>damping [%]</th></tr></thead><tbody>" +
            mode_rows(all.coupled_modes) + "</tbody></table>";
  for (const std::string &warning : apps::all_warnings(all))
    text += "<p>Warning: " + apps::escape_xml(warning) + "</p>";
  return text + "</div>";
}

} // namespace gestell::python

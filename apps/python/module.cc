// The module _gestell, which gestell.py uses.

#include "apps/analysis/result_folder.h"
#include "apps/output/folder_lock.h"
#include "apps/output/tables/result_tables.h"
#include "apps/output/tables/summary_json.h"
#include "apps/output/values/along_result.h"
#include "apps/output/values/sensitivity_result.h"
#include "apps/output/values/state_space_model.h"
#include "apps/python/answer_values.h"
#include "apps/python/bind_scene.h"
#include "apps/python/errors.h"
#include "apps/python/python_frame.h"
#include "apps/python/python_result.h"
#include "apps/python/user_functions.h"
#include "apps/session/checkpoint/input_files.h"
#include "apps/version.h"

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace gestell::python
{
namespace
{

namespace py = pybind11;
using namespace pybind11::literals;

py::dict energy_of(const PythonResult &result)
{
  const auto &energy = result.run().energy;
  return py::dict("input"_a = energy.input, "stored"_a = energy.stored, "dissipated"_a = energy.dissipated,
                  "residual"_a = energy.residual, "exchanged"_a = energy.exchanged);
}

py::dict peaks_of(const PythonResult &result)
{
  py::dict peaks;
  for (const coupling::SignalSummary &signal : result.run().signals)
    peaks[py::str(signal.name)] = signal;
  return peaks;
}

py::dict units_of(const PythonResult &result)
{
  py::dict units;
  for (std::size_t i = 0; i < result.run().columns.size(); ++i)
    units[py::str(result.run().columns[i])] = result.run().units[i];
  return units;
}

template <double coupling::Mode::*Number>
std::vector<double> numbers_of(const PythonResult &result)
{
  std::vector<double> numbers;
  for (const coupling::Mode &mode : result.result().coupled_modes)
    numbers.push_back(mode.*Number);
  return numbers;
}

/// [output x key], with their names.
py::object sensitivities_of(const PythonResult &result)
{
  const auto *found = apps::answer_in<apps::SensitivityResult>(result.result().answers);
  if (!found)
    return py::none();
  if (!found->failure.empty())
    throw std::runtime_error("the run has no sensitivities: " + found->failure);
  py::dict all;
  for (const apps::SensitivityOutput &output : found->outputs)
  {
    py::dict of_output;
    for (std::size_t k = 0; k < found->keys.size(); ++k)
      of_output[py::str(found->keys[k].key)] = output.derivative[Eigen::Index(k)];
    all[py::str(output.output)] = of_output;
  }
  return all;
}

/// Arrays by name; names of several words are tuples.
py::dict arrays_of(const PythonResult &result)
{
  py::dict all;
  for (const auto &answer : result.result().answers)
    for (const apps::NamedArray &array : answer->arrays())
    {
      const py::object name =
          array.name.size() == 1 ? py::object(py::str(array.name[0])) : py::tuple(py::cast(array.name));
      const py::array values = py::array_t<std::complex<double>>(py::ssize_t(array.values.size()), array.values.data());
      all[name]              = array.real ? py::object(values.attr("real").attr("copy")()) : py::object(values);
    }
  return all;
}

Eigen::MatrixXd states_of(const PythonResult &result)
{
  const auto     &states = result.run().picture_states;
  Eigen::MatrixXd all(Eigen::Index(states.size()), states.empty() ? 0 : states.front().size());
  for (std::size_t i = 0; i < states.size(); ++i)
    all.row(Eigen::Index(i)) = states[i].transpose();
  return all;
}

std::vector<std::string> save(PythonResult &result, const py::object &folder)
{
  const std::string    path      = py::str(folder).cast<std::string>();
  const apps::Request &requested = result.result().requested;
  apps::require_writable(path);
  const apps::FolderLock held(path);
  apps::prepare_folder(path, apps::input_files(requested.file, requested.set));
  return apps::write_results(path, result.whole_result());
}

void bind_values(py::module_ &module)
{
  py::class_<coupling::SignalSummary>(module, "Peak", "Extremes of a signal with their times [s].")
      .def_readonly("name", &coupling::SignalSummary::name, "Name of the signal.")
      .def_readonly("unit", &coupling::SignalSummary::unit, "Unit of min, max and final, in SI.")
      .def_readonly("min", &coupling::SignalSummary::min, "Smallest value, in `unit`.")
      .def_readonly("t_min", &coupling::SignalSummary::t_min, "Time of the smallest value [s].")
      .def_readonly("max", &coupling::SignalSummary::max, "Largest value, in `unit`.")
      .def_readonly("t_max", &coupling::SignalSummary::t_max, "Time of the largest value [s].")
      .def_readonly("final", &coupling::SignalSummary::final, "Value at the end of the run, in `unit`.")
      .def("__repr__",
           [](const coupling::SignalSummary &peak)
           {
             return py::str("Peak({}: min {:.6g} at {:.6g} s, max {:.6g} at {:.6g} s, {})")
                 .format(peak.name, peak.min, peak.t_min, peak.max, peak.t_max, peak.unit);
           });
  py::class_<coupling::Event>(module, "Event", "Event (change of branch of a law): t [s], name of the element, kind.")
      .def_readonly("t", &coupling::Event::t, "Time of the event [s].")
      .def_readonly("name", &coupling::Event::name, "Name of the element, joint or switch.")
      .def_readonly("kind", &coupling::Event::kind, "Kind of the event, such as \"contact\" or \"sticks\".")
      .def("__repr__", [](const coupling::Event &event)
           { return py::str("Event({:.9g} s: {}, {})").format(event.t, event.name, event.kind); });
}

void bind_finding(py::module_ &module)
{
  py::class_<coupling::Finding>(module, "Finding", "Finding of a check.")
      .def_property_readonly(
          "severity",
          [](const coupling::Finding &finding)
          { return finding.severity == coupling::Severity::error ? "error" : "warning"; },
          "\"warning\" or \"error\".")
      .def_readonly("id", &coupling::Finding::id, "Kind of finding, \"energy-balance\"; empty: not of the run.")
      .def_readonly("place", &coupling::Finding::place, "Element, joint, switch, signal or key; empty: the whole run.")
      .def_readonly("text", &coupling::Finding::text, "Problem, location and remedy.")
      .def("__repr__", [](const coupling::Finding &finding)
           { return py::str("Finding({}, {}: {})").format(finding.id, finding.place, finding.text); });
}

void bind_result(py::module_ &module)
{
  py::class_<PythonResult, std::shared_ptr<PythonResult>>(module, "Result", "Results of a scene; arrays are views.")
      .def("__getitem__", &column_view, "name"_a, "History of a signal [rows], a view.")
      .def("__contains__",
           [](const PythonResult &result, const std::string &name)
           {
             const auto &names = result.run().columns;
             return std::find(names.begin(), names.end(), name) != names.end();
           })
      .def_property_readonly(
          "t", [](const py::object &result) { return column_view(result, "t"); }, "Times [s], a view.")
      .def_property_readonly("history", &history_view, "All columns [rows x columns], a view.")
      .def_property_readonly(
          "columns", [](const PythonResult &result) { return result.run().columns; },
          "Names of the columns of `history`: t, signals, energies.")
      .def_property_readonly("units", &units_of, "Unit of each column of `history`, a dict.")
      .def_property_readonly("peaks", &peaks_of, "Extremes of each signal, a dict of Peak.")
      .def_property_readonly(
          "events", [](const PythonResult &result) { return result.run().events; }, "Events, in the order of time [s].")
      .def_property_readonly("energy", &energy_of, "Input, stored, dissipated, residual, exchanged [J].")
      .def_property_readonly(
          "warnings", [](const PythonResult &result) { return apps::all_warnings(result.result()); },
          "Warnings of scene, frame and run, each once.")
      .def_property_readonly(
          "findings", [](const PythonResult &result) { return apps::all_findings(result.result()); },
          "The same warnings as a list of Finding, with severity, id and place.")
      .def_property_readonly(
          "scene", [](const PythonResult &result) { return result.result().scene; }, "Name of the scene.")
      .def_property_readonly(
          "coordinates", [](const PythonResult &result) { return result.result().coordinate_names; },
          "Names of the machine's coordinates, rows of `shapes` and columns of `states`.")
      .def_property_readonly(
          "frequencies_hz",
          [](const PythonResult &result)
          { return py::array(py::cast(numbers_of<&coupling::Mode::frequency_hz>(result))); },
          "Natural frequencies of the coupled machine [Hz].")
      .def_property_readonly(
          "damping_ratios",
          [](const PythonResult &result)
          { return py::array(py::cast(numbers_of<&coupling::Mode::damping_ratio>(result))); },
          "Damping ratio of each mode [1]; nan without vibration.")
      .def_property_readonly(
          "shapes", [](const PythonResult &result) { return shapes_of(result.result().coupled_modes); },
          "Mode shapes in columns [coordinates x modes], mass normalised.")
      .def_property_readonly(
          "frame_shapes", [](const PythonResult &result) { return shapes_of(result.result().frame_modes); },
          "Mode shapes of the frame alone in columns, mass normalised.")
      .def_property_readonly(
          "picture_times",
          [](const PythonResult &result) {
            return py::array_t<double>(py::ssize_t(result.run().picture_times.size()),
                                       result.run().picture_times.data());
          },
          "Times of `states` [s].")
      .def_property_readonly("states", &states_of, "Coordinates at picture_times [times x coordinates], m or rad.")
      .def_property_readonly("sensitivities", &sensitivities_of,
                             "Derivatives of each output by each key, a dict of dicts in SI; None: not requested.")
      .def_property_readonly("_arrays", &arrays_of)
      .def_property_readonly("_periodic",
                             [](const PythonResult &result) -> py::object
                             {
                               const auto *motions = apps::answer_in<apps::PeriodicResult>(result.result().answers);
                               return motions ? py::object(periodic_values(*motions)) : py::none();
                             })
      .def_property_readonly("_along",
                             [](const PythonResult &result) -> py::object
                             {
                               const auto *along = apps::answer_in<apps::AlongResult>(result.result().answers);
                               return along ? py::object(along_values(*along)) : py::none();
                             })
      .def_property_readonly("_summary", [](const PythonResult &result) { return apps::summary_json(result.result()); })
      .def("save", &save, "folder"_a, "Writes report.html, history.csv and all other files; returns their names.")
      .def("_repr_html_", &notebook_text);
}

template <Eigen::MatrixXd coupling::StateSpace::*Matrix>
const Eigen::MatrixXd &matrix_of(const apps::StateSpaceModel &model)
{
  return model.system.*Matrix;
}

void bind_state_space(py::module_ &module)
{
  using apps::StateSpaceModel;
  using coupling::StateSpace;
  constexpr auto view = py::return_value_policy::reference_internal;
  py::class_<StateSpaceModel, std::shared_ptr<StateSpaceModel>>(
      module, "StateSpace", "x' = A x + B u, y = C x + D u about an operating point; x = (r, r'), q = Z r, all in SI.")
      .def_property_readonly("A", &matrix_of<&StateSpace::A>, view, "[states x states], SI.")
      .def_property_readonly("B", &matrix_of<&StateSpace::B>, view, "[states x inputs], per N.")
      .def_property_readonly("C", &matrix_of<&StateSpace::C>, view, "[outputs x states], SI.")
      .def_property_readonly("D", &matrix_of<&StateSpace::D>, view, "[outputs x inputs], per N.")
      .def_property_readonly("Z", &matrix_of<&StateSpace::Z>, view, "[coordinates x states/2], q = Z r, m or rad.")
      .def_readonly("states", &StateSpaceModel::states, "Names of the states x.")
      .def_readonly("coordinates", &StateSpaceModel::coordinates, "Names of the machine's coordinates, rows of Z.")
      .def_readonly("inputs", &StateSpaceModel::inputs, "Names of the inputs with their units.")
      .def_readonly("outputs", &StateSpaceModel::outputs, "Names of the outputs with their units.")
      .def_readonly("t", &StateSpaceModel::t, "Time of the operating point [s].")
      .def("__iter__", [](const py::object &model)
           { return py::iter(py::make_tuple(model.attr("A"), model.attr("B"), model.attr("C"), model.attr("D"))); });
}

} // namespace
} // namespace gestell::python

PYBIND11_MODULE(_gestell, module)
{
  using namespace gestell::python;
  module.attr("version") = gestell::apps::version;
  bind_errors(module);
  bind_values(module);
  bind_finding(module);
  bind_result(module);
  bind_frames(module);
  bind_state_space(module);
  bind_user_functions(module);
  bind_scene(module);
}

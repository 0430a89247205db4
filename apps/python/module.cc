// The module _gestell, on which gestell.py rests.

#include "apps/output/result_folder.h"
#include "apps/output/tables/result_tables.h"
#include "apps/python/python_scene.h"
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

/// Wrong input and failed methods, with the texts of the program.
void translate_errors(py::module_ &module)
{
  static py::object input  = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
       "gestell.InputError", "Wrong input: place, value, what is needed, way out.", PyExc_ValueError, nullptr));
  static py::object failed = py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(
      "gestell.ComputationFailed", "The computation failed; result holds what was computed until then.",
      PyExc_RuntimeError, nullptr));
  input.inc_ref(); // for as long as the interpreter runs
  failed.inc_ref();
  module.attr("InputError")        = input;
  module.attr("ComputationFailed") = failed;
  py::register_exception_translator(
      [](std::exception_ptr error)
      {
        try
        {
          if (error)
            std::rethrow_exception(error);
        }
        catch (const py::builtin_exception &)
        {
          throw;
        }
        catch (const std::invalid_argument &wrong)
        {
          PyErr_SetString(input.ptr(), wrong.what());
        }
        catch (const std::runtime_error &none)
        {
          PyErr_SetString(failed.ptr(), none.what());
        }
      });
}

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
  const auto &found = result.result().sensitivities;
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
  return std::move(all);
}

py::object responses_of(const PythonResult &result)
{
  const auto &found = result.result().frf;
  if (!found)
    return py::none();
  py::dict pairs;
  for (const apps::ResponsePair &pair : found->pairs)
    pairs[py::make_tuple(pair.from, pair.to)] =
        py::array_t<std::complex<double>>(py::ssize_t(pair.values.size()), pair.values.data());
  return py::make_tuple(py::array_t<double>(py::ssize_t(found->frequencies_hz.size()), found->frequencies_hz.data()),
                        pairs);
}

Eigen::MatrixXd states_of(const PythonResult &result)
{
  const auto     &states = result.run().picture_states;
  Eigen::MatrixXd all(Eigen::Index(states.size()), states.empty() ? 0 : states.front().size());
  for (std::size_t i = 0; i < states.size(); ++i)
    all.row(Eigen::Index(i)) = states[i].transpose();
  return all;
}

std::vector<std::string> save(const PythonResult &result, const py::object &folder)
{
  const std::string path = py::str(folder).cast<std::string>();
  apps::require_writable(path);
  apps::prepare_folder(path);
  return apps::write_results(path, result.result());
}

void bind_values(py::module_ &module)
{
  py::class_<coupling::SignalSummary>(module, "Peak", "Extremes of a signal with their times [s].")
      .def_readonly("name", &coupling::SignalSummary::name)
      .def_readonly("unit", &coupling::SignalSummary::unit)
      .def_readonly("min", &coupling::SignalSummary::min)
      .def_readonly("t_min", &coupling::SignalSummary::t_min)
      .def_readonly("max", &coupling::SignalSummary::max)
      .def_readonly("t_max", &coupling::SignalSummary::t_max)
      .def_readonly("final", &coupling::SignalSummary::final)
      .def("__repr__",
           [](const coupling::SignalSummary &peak)
           {
             return py::str("Peak({}: min {:.6g} at {:.6g} s, max {:.6g} at {:.6g} s, {})")
                 .format(peak.name, peak.min, peak.t_min, peak.max, peak.t_max, peak.unit);
           });
  py::class_<coupling::Event>(module, "Event", "A law changes its branch: t [s], name of the element, kind.")
      .def_readonly("t", &coupling::Event::t)
      .def_readonly("name", &coupling::Event::name)
      .def_readonly("kind", &coupling::Event::kind)
      .def("__repr__", [](const coupling::Event &event)
           { return py::str("Event({:.9g} s: {}, {})").format(event.t, event.name, event.kind); });
}

void bind_result(py::module_ &module)
{
  py::class_<PythonResult, std::shared_ptr<PythonResult>>(module, "Result",
                                                          "What was computed of a scene; arrays show its memory.")
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
      .def_property_readonly("columns", [](const PythonResult &result) { return result.run().columns; })
      .def_property_readonly("units", &units_of, "Unit of each column.")
      .def_property_readonly("peaks", &peaks_of, "Extremes of each signal.")
      .def_property_readonly("events", [](const PythonResult &result) { return result.run().events; })
      .def_property_readonly("energy", &energy_of, "Input, stored, dissipated, residual, exchanged [J].")
      .def_property_readonly("warnings", [](const PythonResult &result) { return apps::all_warnings(result.result()); })
      .def_property_readonly("scene", [](const PythonResult &result) { return result.result().scene; })
      .def_property_readonly("coordinates", [](const PythonResult &result) { return result.result().coordinate_names; })
      .def_property_readonly(
          "frequencies_hz",
          [](const PythonResult &result)
          { return py::array(py::cast(numbers_of<&coupling::Mode::frequency_hz>(result))); },
          "Natural frequencies of the coupled machine [Hz].")
      .def_property_readonly("damping_ratios", [](const PythonResult &result)
                             { return py::array(py::cast(numbers_of<&coupling::Mode::damping_ratio>(result))); })
      .def_property_readonly(
          "shapes", [](const PythonResult &result) { return shapes_of(result.result().coupled_modes); },
          "Mode shapes in columns [coordinates x modes], mass normalised.")
      .def_property_readonly("frame_shapes",
                             [](const PythonResult &result) { return shapes_of(result.result().frame_modes); })
      .def_property_readonly("picture_times",
                             [](const PythonResult &result) {
                               return py::array_t<double>(py::ssize_t(result.run().picture_times.size()),
                                                          result.run().picture_times.data());
                             })
      .def_property_readonly("states", &states_of, "Coordinates at picture_times [times x coordinates].")
      .def_property_readonly("sensitivities", &sensitivities_of,
                             "Derivatives of each output by each key, a dict of dicts; None: not asked for.")
      .def_property_readonly("_responses", &responses_of)
      .def_property_readonly("_summary", [](const PythonResult &result) { return apps::summary_json(result.result()); })
      .def("save", &save, "folder"_a, "Writes report.html, history.csv and all other files; returns their names.")
      .def("_repr_html_", &notebook_text);
}

void bind_frame(py::module_ &module)
{
  const auto matrix = [](Eigen::MatrixXd coupling::ReducedFrame::*which)
  {
    return py::cpp_function([which](const PythonFrame &frame) -> const Eigen::MatrixXd &
                            { return (*frame.frame).*which; },
                            py::return_value_policy::reference_internal);
  };
  py::class_<PythonFrame, std::shared_ptr<PythonFrame>>(module, "Frame", "A reduced frame; its matrices are views.")
      .def_property_readonly("M", matrix(&coupling::ReducedFrame::M), "Mass matrix [kg].")
      .def_property_readonly("B", matrix(&coupling::ReducedFrame::B), "Damping matrix [N s/m].")
      .def_property_readonly("C", matrix(&coupling::ReducedFrame::C), "Stiffness matrix [N/m].")
      .def_property_readonly("coordinates", &PythonFrame::coordinates, "Names of rows: interfaces first, then modes.")
      .def_property_readonly("n_interface", [](const PythonFrame &frame) { return frame.frame->n_interface; })
      .def_property_readonly("n_full", [](const PythonFrame &frame) { return frame.frame->n_full; })
      .def_property_readonly(
          "mass", [](const PythonFrame &frame) { return frame.frame->mass; }, "[kg]")
      .def_property_readonly(
          "frequencies_hz",
          [](const PythonFrame &frame) -> const Eigen::VectorXd & { return frame.frame->frequencies_hz; },
          py::return_value_policy::reference_internal, "Of the frame alone, interface free [Hz].");
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
      .def_property_readonly("A", &matrix_of<&StateSpace::A>, view)
      .def_property_readonly("B", &matrix_of<&StateSpace::B>, view)
      .def_property_readonly("C", &matrix_of<&StateSpace::C>, view)
      .def_property_readonly("D", &matrix_of<&StateSpace::D>, view)
      .def_property_readonly("Z", &matrix_of<&StateSpace::Z>, view)
      .def_readonly("states", &StateSpaceModel::states)
      .def_readonly("coordinates", &StateSpaceModel::coordinates)
      .def_readonly("inputs", &StateSpaceModel::inputs)
      .def_readonly("outputs", &StateSpaceModel::outputs)
      .def_readonly("t", &StateSpaceModel::t, "[s] of the operating point")
      .def("__iter__", [](const py::object &model)
           { return py::iter(py::make_tuple(model.attr("A"), model.attr("B"), model.attr("C"), model.attr("D"))); });
}

void bind_scene(py::module_ &module)
{
  const auto run = [](const PythonScene &scene, std::optional<std::vector<std::string>> peaks,
                      std::string sensitivities) {
    return scene.run({std::move(peaks), std::move(sensitivities)});
  };
  const auto frf = [](const PythonScene &scene, std::vector<std::string> from, std::vector<std::string> to,
                      const std::string &kind, const std::string &at, const std::string &lowest,
                      const std::string &highest, int points)
  {
    apps::FrfOptions options;
    options.from    = std::move(from);
    options.to      = std::move(to);
    options.kind    = kind;
    options.at      = at;
    options.lowest  = lowest;
    options.highest = highest;
    options.points  = points;
    return scene.frequency_response(options);
  };
  py::class_<PythonScene>(module, "Scene")
      .def_static("of_file", &PythonScene::of_file)
      .def_static("of_text", &PythonScene::of_text)
      .def_static("of_values", &PythonScene::of_values)
      .def("copy", [](const PythonScene &scene) { return scene; })
      .def("set", &PythonScene::set)
      .def("get", &PythonScene::get)
      .def("values", &PythonScene::values)
      .def("name", &PythonScene::name)
      .def("signals", &PythonScene::signals)
      .def("check", &PythonScene::check)
      .def("run", run, "peaks"_a, "sensitivities"_a)
      .def("modes", &PythonScene::modes)
      .def("frame", &PythonScene::frame)
      .def("frequency_response", frf)
      .def("state_space",
           [](const PythonScene &scene, std::vector<std::string> from, std::vector<std::string> to,
              const std::string &kind, const std::string &at)
           {
             apps::FrfOptions options;
             options.from = std::move(from);
             options.to   = std::move(to);
             options.kind = kind;
             options.at   = at;
             return scene.state_space(options);
           });
}

} // namespace
} // namespace gestell::python

PYBIND11_MODULE(_gestell, module)
{
  using namespace gestell::python;
  module.attr("version") = gestell::apps::version;
  translate_errors(module);
  bind_values(module);
  bind_result(module);
  bind_frame(module);
  bind_state_space(module);
  bind_scene(module);
}

#include "apps/python/bind_scene.h"

#include "apps/analysis/analyses.h"
#include "apps/python/answer_values.h"
#include "apps/python/python_scene.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace gestell::python
{
namespace
{

namespace py = pybind11;
using namespace pybind11::literals;
using Names = std::vector<std::string>;

std::shared_ptr<PythonResult> run(const PythonScene &scene, std::optional<Names> signals, bool history, bool lean,
                                  std::string sensitivities, py::object progress)
{
  return scene.run({std::move(signals), history, lean, {{"--sensitivities", {sensitivities}}}, std::move(progress)});
}

apps::FrfOptions response_options(Names from, Names to, const std::string &kind, const std::string &at)
{
  apps::FrfOptions options;
  options.from = std::move(from);
  options.to   = std::move(to);
  options.kind = kind;
  options.at   = at;
  return options;
}

py::tuple size(const PythonScene &scene, double tolerance, const std::string &outputs, double max_cpu, bool exhaustive)
{
  auto [found, sized] = scene.size({tolerance, outputs, max_cpu, exhaustive});
  return py::make_tuple(size_values(found), std::move(sized));
}

} // namespace

void bind_scene(py::module_ &module)
{
  py::dict analyses;
  for (const apps::AnalysisEntry &entry : apps::analyses())
  {
    if (!entry.is_command())
      continue;
    py::list options;
    for (const apps::CommandOption &option : entry.begin()->options())
      if (!option.writes)
        options.append(py::make_tuple(option.name, option.does));
    analyses[py::str(entry.name)] = py::make_tuple(entry.does, options);
  }
  module.attr("analyses") = analyses;
  py::class_<PythonScene>(module, "Scene", "Contents of a gestell.Scene.")
      .def_static("of_file", &PythonScene::of_file)
      .def_static("of_text", &PythonScene::of_text)
      .def_static("of_values", &PythonScene::of_values)
      .def("copy", [](const PythonScene &scene) { return scene; })
      .def("set", &PythonScene::set)
      .def("add", &PythonScene::add)
      .def("get", &PythonScene::get)
      .def("values", &PythonScene::values)
      .def("name", &PythonScene::name)
      .def("signals", &PythonScene::signals)
      .def("check", &PythonScene::check)
      .def("words", &PythonScene::words)
      .def("run", &run)
      .def("modes", &PythonScene::modes)
      .def("frame", &PythonScene::frame)
      .def("full_frame", &PythonScene::full_frame)
      .def("analyse", &PythonScene::analyse)
      .def("state_space",
           [](const PythonScene &scene, Names from, Names to, const std::string &kind, const std::string &at)
           { return scene.state_space(response_options(std::move(from), std::move(to), kind, at)); })
      .def("stability",
           [](const PythonScene &scene, double step) { return apps::stability_answer(scene.stability(step)); })
      .def("size", &size);
}

} // namespace gestell::python

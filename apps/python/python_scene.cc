#include "apps/python/python_scene.h"

#include "apps/python/interruptible.h"
#include "apps/python/scene_values.h"
#include "apps/scene/build/build_machine.h"
#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/toml_text.h"
#include "apps/session/exchange/state_space_answer.h"
#include "apps/study/runs/frame_shelf.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <type_traits>

namespace gestell::python
{
namespace
{

namespace py = pybind11;
namespace fs = std::filesystem;
using apps::Place;
using apps::Scene;
using apps::SceneNode;

/// Where a scene without a file stands.
std::string path_in(const std::string &folder)
{
  return (fs::absolute(folder) / "scene").lexically_normal().string();
}

std::string folder_of_path(const std::string &path)
{
  return fs::path(path).parent_path().string();
}

std::vector<std::string> names_of(const SceneNode &table)
{
  std::vector<std::string> names;
  for (const auto &entry : table.entries)
    names.push_back(entry.first);
  return names;
}

/// Anything else that a scene does not have is refused when it is read; a parameter would only go unused.
void require_known_parameter(const SceneNode &root, const std::vector<std::string> &key, const Place &place)
{
  const SceneNode *parameters = root.find("parameters");
  if (key.size() == 2 && key[0] == "parameters" && !(parameters && parameters->find(key[1])))
    place.fail("the scene has no parameter '" + key[1] + "'" +
               suggestion(key[1], parameters ? names_of(*parameters) : std::vector<std::string>()));
}

/// As StudyRunner does.
void keep_peaks_alone(Scene &scene, const std::vector<std::string> &signals)
{
  std::vector<std::string> known;
  for (const apps::SignalRequest &signal : scene.signals)
    known.push_back(signal.name);
  for (const std::string &name : signals)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw std::invalid_argument("peaks: the scene has no signal '" + name + "'" + suggestion(name, known));
  auto &all = scene.signals;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [&](const apps::SignalRequest &signal)
                           { return std::find(signals.begin(), signals.end(), signal.name) == signals.end(); }),
            all.end());
  coupling::RunOptions &run = scene.run.options;
  run.picture_step          = 0.;
  run.output_step           = run.end - run.begin;
  run.energy                = false;
}

/// The reduced frames of all scenes; two threads do not make the same.
std::shared_ptr<const coupling::ReducedFrame> shared_frame(const Scene &scene)
{
  static apps::FrameShelf *const shelf = new apps::FrameShelf(true); // outlives what the interpreter ends last
  static std::mutex              alone;
  const std::lock_guard          lock(alone);
  return shelf->frame(scene, {});
}

[[noreturn]] void raise_with(py::object error, const std::shared_ptr<PythonResult> &result)
{
  error.attr("result") = result;
  PyErr_SetObject(reinterpret_cast<PyObject *>(Py_TYPE(error.ptr())), error.ptr());
  throw py::error_already_set();
}

/// Why a run is none, as an exception that has what was computed.
void raise_failure(const std::shared_ptr<PythonResult> &result)
{
  const auto &run = result->result().run;
  if (run && run->interrupted)
    raise_with(py::reinterpret_borrow<py::object>(PyExc_KeyboardInterrupt)(), result);
  if (run && !run->failure.empty())
    raise_with(py::module_::import("_gestell").attr("ComputationFailed")(run->failure), result);
}

/// Computes without the lock of the interpreter.  Ctrl-C is obeyed at the latest when it is done, whatever came of it.
template <typename Compute>
auto interruptibly(const Compute &compute)
{
  const Interruptible interruptible;
  const auto          with_others = [&]
  {
    const py::gil_scoped_release others_may_run;
    return compute(interruptible.asked());
  };
  decltype(with_others()) result;
  try
  {
    result = with_others();
  }
  catch (const std::exception &)
  {
    if (!interruptible.asked())
      throw;
  }
  if constexpr (std::is_same_v<decltype(result), std::shared_ptr<PythonResult>>)
    if (result)
      raise_failure(result);
  if (interruptible.asked())
  {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  return result;
}

} // namespace

PythonScene PythonScene::of_file(const std::string &path)
{
  PythonScene scene(apps::read_scene_file(path, {}), path);
  scene.is_file_ = true;
  return scene;
}

PythonScene PythonScene::of_text(const std::string &text, const std::string &folder)
{
  const std::string path = path_in(folder);
  return {apps::with_extended(apps::parse_toml_text(text, "scene", folder_of_path(path)), path), path};
}

PythonScene PythonScene::of_values(const py::dict &values, const std::string &folder)
{
  const std::string path = path_in(folder);
  return {apps::with_extended(node_of(values, Place{"scene", 0}, folder_of_path(path)), path), path};
}

void PythonScene::set(const std::string &key, py::handle value)
{
  const Place     place{"scene[\"" + key + "\"]", 0};
  const SceneNode node = node_of(value, place, fs::current_path().string());
  require_known_parameter(root_, apps::key_segments(key, place), place);
  apps::apply_override(root_, key, node);
  overrides_.push_back(key + "=" + toml_of(node));
}

py::object PythonScene::get(const std::string &key) const
{
  const SceneNode *node = &root_;
  for (const std::string &segment : apps::key_segments(key, Place{"scene[\"" + key + "\"]", 0}))
  {
    const SceneNode *next = node->find(segment);
    if (!next)
      throw py::key_error(key + suggestion(segment, names_of(*node)));
    node = next;
  }
  return value_of(*node);
}

py::object PythonScene::values() const
{
  return value_of(root_);
}

std::string PythonScene::name() const
{
  return scene().name;
}

std::vector<std::string> PythonScene::signals() const
{
  std::vector<std::string> names;
  for (const apps::SignalRequest &signal : scene().signals)
    names.push_back(signal.name);
  return names;
}

std::vector<std::string> PythonScene::check() const
{
  const Scene scene    = this->scene();
  auto        warnings = apps::check_scene(scene);
  warnings.insert(warnings.begin(), scene.warnings.begin(), scene.warnings.end());
  return warnings;
}

std::shared_ptr<apps::Session> PythonScene::session(Scene scene, const std::atomic<bool> *stop) const
{
  const auto frame  = shared_frame(scene);
  auto       result = std::make_shared<apps::Session>(std::move(scene), overrides_, apps::Watch{{}, stop});
  if (frame)
    result->use_frame(*frame);
  return result;
}

std::shared_ptr<PythonResult> PythonScene::run(const RunChoice &choice) const
{
  if (!choice.sensitivities.empty() && !is_file_)
    throw std::invalid_argument("sensitivities: need a scene from a file, which is read again for each entry");
  return interruptibly(
      [&](const std::atomic<bool> &stop)
      {
        Scene scene = this->scene();
        apps::require_run(scene);
        if (choice.peaks)
          keep_peaks_alone(scene, *choice.peaks);
        auto session = this->session(std::move(scene), &stop);
        auto run     = choice.sensitivities.empty() ? session->run() : session->run(choice.sensitivities);
        return std::make_shared<PythonResult>(std::move(session), std::move(run));
      });
}

std::shared_ptr<PythonResult> PythonScene::modes() const
{
  return interruptibly(
      [&](const std::atomic<bool> &stop)
      {
        auto session = this->session(scene(), &stop);
        auto modes   = session->modes();
        return std::make_shared<PythonResult>(std::move(session), std::move(modes));
      });
}

std::shared_ptr<PythonResult> PythonScene::frequency_response(const apps::FrfOptions &options) const
{
  return interruptibly(
      [&](const std::atomic<bool> &stop)
      {
        auto session = this->session(scene(), &stop);
        auto answer  = session->frequency_response(options);
        return std::make_shared<PythonResult>(std::move(session), std::move(answer));
      });
}

std::shared_ptr<apps::StateSpaceModel> PythonScene::state_space(const apps::FrfOptions &options) const
{
  return interruptibly(
      [&](const std::atomic<bool> &stop)
      {
        const auto session = this->session(scene(), &stop);
        return std::make_shared<apps::StateSpaceModel>(
            apps::state_space_of(session->scene(), session->machine(), options));
      });
}

std::shared_ptr<PythonFrame> PythonScene::frame() const
{
  return interruptibly(
      [&](const std::atomic<bool> &)
      {
        const Scene scene = this->scene();
        auto        frame = shared_frame(scene);
        if (!frame)
          throw std::invalid_argument(
              scene.frame.place + ": the scene has no frame that is reduced; its matrices are M, B, C of [frame], or "
                                  "reduction.method = \"craig-bampton\" reduces it");
        return std::make_shared<PythonFrame>(std::move(frame));
      });
}

} // namespace gestell::python

#include "apps/python/python_scene.h"

#include "apps/analysis/analyses.h"
#include "apps/analysis/frf/state_space_answer.h"
#include "apps/atlas/scene_stability.h"
#include "apps/python/callback_progress.h"
#include "apps/python/errors.h"
#include "apps/python/interruptible.h"
#include "apps/python/scene_values.h"
#include "apps/python/user_functions.h"
#include "apps/scene/build/build_machine.h"
#include "apps/scene/build/scene_summary.h"
#include "apps/scene/file/extending_scene.h"
#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/scene_override.h"
#include "apps/scene/file/toml_text.h"
#include "apps/session/reduced_frame_store.h"
#include "apps/sizing/sized_scene.h"
#include "coupling/plugin/mesh_service.h"
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

/// Path of a scene without a file.
std::string path_in(const std::string &folder)
{
  return (fs::absolute(folder) / "scene").lexically_normal().string();
}

std::string folder_of_path(const std::string &path)
{
  return fs::path(path).parent_path().string();
}

/// Anything else that a scene does not have is refused when it is read; a parameter would only go unused.
void require_known_parameter(const SceneNode &root, const std::vector<std::string> &key, const Place &place)
{
  const auto all = apps::names_in(root.find("parameters"));
  if (key.size() == 2 && key[0] == "parameters" && std::find(all.begin(), all.end(), key[1]) == all.end())
    place.fail("the scene has no parameter '" + key[1] + "'" + suggestion(key[1], all));
}

/// Removes unselected signals, and output that the choice does not need.
void keep(Scene &scene, const RunChoice &choice)
{
  coupling::RunOptions &run = scene.run.options;
  if (choice.signals)
    apps::keep_signals(scene, *choice.signals);
  if (choice.lean || !choice.history)
  {
    run.picture_step = 0.;
    run.energy       = false;
  }
  if (!choice.history)
    run.output_step = run.end - run.begin;
}

/// Marks the thread that computes a frame, during the lifetime of this object.
class MakingFrame
{
public:
  MakingFrame()
  {
    if (here)
      throw std::invalid_argument("the progress function requests a frame while another one is being computed; compute "
                                  "it before or after the run");
    here = true;
  }
  ~MakingFrame() { here = false; }
  MakingFrame(const MakingFrame &) = delete;

private:
  static inline thread_local bool here = false;
};

/// The reduced frame of a scene; concurrent threads do not compute the same frame twice.
std::shared_ptr<const coupling::ReducedFrame> shared_frame(const Scene &scene, const coupling::Progress &progress)
{
  static apps::ReducedFrameStore *const shelf =
      new apps::ReducedFrameStore(true); // outlives what the interpreter ends last
  static std::mutex alone;
  if (!apps::on_reduced_frame(scene))
    return nullptr;
  const MakingFrame     once;
  const std::lock_guard lock(alone);
  return shelf->frame(scene, progress);
}

[[noreturn]] void raise_with(py::object error, const std::shared_ptr<PythonResult> &result, const py::object &cause)
{
  error.attr("result") = result;
  if (!cause.is_none())
    error.attr("__cause__") = cause;
  PyErr_SetObject(reinterpret_cast<PyObject *>(Py_TYPE(error.ptr())), error.ptr());
  throw py::error_already_set();
}

/// Raises a failure that is caused by what a function of the scene raised, if one did.
void raise_cause(const std::string &why, const SceneNode &root, const std::shared_ptr<PythonResult> &result)
{
  if (const py::object cause = take_raised(root); !cause.is_none())
  {
    raise_if_it_ends_the_program(cause);
    raise_with(computation_failed(why + "\n" + traceback_text(cause)), result, cause);
  }
}

/// Why a run is none, as an exception that has what was computed; caused by what a function of the scene raised.
void raise_failure(const std::shared_ptr<PythonResult> &result, const SceneNode &root)
{
  const auto &run = result->result().run;
  if (run && run->interrupted)
    raise_with(py::reinterpret_borrow<py::object>(PyExc_KeyboardInterrupt)(), result, py::none());
  if (run && !run->failure.empty())
  {
    py::object cause = take_raised(root);
    raise_if_it_ends_the_program(cause);
    if (!cause.is_none() && run->failure.find(traceback_text(cause)) == std::string::npos)
      cause = py::none(); // it was overcome: a shorter step had a value
    raise_with(computation_failed(run->failure), result, cause);
  }
}

/// Computes without the lock of the interpreter: `compute` has a scene of its own, as others may change theirs.  Ctrl-C
/// and what `progress` raises are obeyed at the latest when it is done, whatever came of it.
template <typename Compute>
auto interruptibly(const SceneNode &root, const Compute &compute, py::object progress = py::none())
{
  take_raised(root); // of earlier computations
  const Interruptible interruptible;
  CallbackProgress    reported(std::move(progress), interruptible.requested());
  const auto          with_others = [&]
  {
    const py::gil_scoped_release unlocked;
    return compute(reported.watch());
  };
  std::optional<decltype(with_others())> result;
  try
  {
    result.emplace(with_others());
  }
  catch (const py::error_already_set &)
  {
    throw;
  }
  catch (const std::exception &failure)
  {
    reported.raise();
    if (!interruptible.requested())
    {
      raise_cause(failure.what(), root, nullptr);
      throw;
    }
  }
  reported.raise();
  std::shared_ptr<PythonResult> of_failure;
  if constexpr (std::is_same_v<decltype(result), std::optional<std::shared_ptr<PythonResult>>>)
    if (result)
      raise_failure(of_failure = *result, root);
  if (interruptible.requested())
  {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  if (!of_failure || !of_failure->result().run)
    raise_cause("a function of the scene failed", root, of_failure);
  return std::move(*result);
}

/// The frame of a scene that can be had unreduced.
fem::FrameMatrices assembled(const Scene &scene, const coupling::Progress &progress)
{
  if (scene.frame.source == apps::FrameSource::geometry)
    return coupling::mesh_service().assemble(scene.frame.geometry, scene.reduction.options, progress).matrices;
  if (scene.frame.source == apps::FrameSource::matrices)
    return scene.frame.matrices;
  throw std::invalid_argument((scene.frame.place.empty() ? "scene" : scene.frame.place) +
                              ": the scene has no single frame from CAD or matrices; frames of parts and reduced "
                              "frames have no unreduced matrices");
}

} // namespace

PythonScene PythonScene::of_file(const std::string &path)
{
  return PythonScene(apps::Variant::of_file(path));
}

PythonScene PythonScene::of_text(const std::string &text, const std::string &folder)
{
  const std::string path = path_in(folder);
  return PythonScene({apps::with_extended(apps::parse_toml_text(text, "scene", folder_of_path(path)), path), path});
}

PythonScene PythonScene::of_values(const py::dict &values, const std::string &folder)
{
  const std::string path = path_in(folder);
  return PythonScene({apps::with_extended(node_of(values, Place{"scene", 0}, folder_of_path(path)), path), path});
}

void PythonScene::set(const std::string &key, py::handle value)
{
  const Place     place{"scene[\"" + key + "\"]", 0};
  const SceneNode node = node_of(value, place, fs::current_path().string());
  require_known_parameter(variant_.root, apps::key_segments(key, place), place);
  apps::apply_override(variant_.root, key, node);
  const std::string of_key  = key + "=";
  auto             &changes = variant_.changes;
  changes.erase(std::remove_if(changes.begin(), changes.end(),
                               [&](const std::string &set) { return set.compare(0, of_key.size(), of_key) == 0; }),
                changes.end());
  changes.push_back(of_key + apps::written_value(node));
}

void PythonScene::add(const std::string &table, const py::dict &entries)
{
  const Place     place{"scene", 0};
  const SceneNode added = node_of(entries, place, folder_of_path(variant_.path), table);
  SceneNode       root  = variant_.root;
  for (const auto &[key, value] : added.entries)
    apps::apply_override(root, table + "." + apps::written_key(key), value);
  variant_.root = std::move(root);
}

py::object PythonScene::get(const std::string &key) const
{
  const SceneNode *node = &variant_.root;
  for (const std::string &segment : apps::key_segments(key, Place{"scene[\"" + key + "\"]", 0}))
  {
    const SceneNode *next = node->find(segment);
    if (!next)
      throw py::key_error(key + suggestion(segment, apps::names_in(node)));
    node = next;
  }
  return value_of(*node);
}

py::object PythonScene::values() const
{
  return value_of(variant_.root);
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
  return apps::check_scene(scene());
}

std::vector<std::string> PythonScene::words() const
{
  const Scene scene = this->scene();
  apps::check_scene(scene);
  return apps::scene_summary(scene);
}

std::shared_ptr<apps::Session> PythonScene::session(Scene scene, const apps::Watch &watch) const
{
  const auto frame  = shared_frame(scene, apps::stoppable(watch.progress, watch.interruption));
  auto       result = std::make_shared<apps::Session>(variant_, std::move(scene), watch);
  if (frame)
    result->use_frame(*frame);
  return result;
}

/// The scene with additional signals for paths such as "slide.displacement", named by their path.
Scene PythonScene::scene_with(const std::vector<std::string> &signals) const
{
  Scene                    scene = this->scene();
  std::vector<std::string> known;
  for (const apps::SignalRequest &signal : scene.signals)
    known.push_back(signal.name);
  apps::Variant other = variant_;
  bool          added = false;
  for (const std::string &name : signals)
  {
    if (std::find(known.begin(), known.end(), name) != known.end())
      continue;
    if (name.find('.') == std::string::npos)
      throw std::invalid_argument("the scene has no signal '" + name + "'" + suggestion(name, known));
    SceneNode path;
    path.type  = SceneNode::Type::text;
    path.text  = name;
    path.place = Place{"signals", 0};
    apps::apply_override(other.root, "output.signals." + apps::written_key(name), path);
    added = true;
  }
  return added ? other.scene() : scene;
}

std::shared_ptr<PythonResult> PythonScene::run(const RunChoice &choice) const
{
  return interruptibly(
      variant_.root,
      [&, self = *this](const apps::Watch &watch)
      {
        Scene scene = choice.signals ? self.scene_with(*choice.signals) : self.scene();
        apps::require_run(scene);
        keep(scene, choice);
        auto session = self.session(std::move(scene), watch);
        auto run     = apps::run_with(apps::analyses_of("run", choice.options), *session);
        return std::make_shared<PythonResult>(std::move(session), std::move(run));
      },
      choice.progress);
}

std::shared_ptr<PythonResult> PythonScene::modes(const apps::OptionTexts &options, py::object progress) const
{
  return interruptibly(
      variant_.root,
      [&, self = *this](const apps::Watch &watch)
      {
        auto       session = self.session(self.scene(), watch);
        auto       modes   = session->modes();
        const auto more    = apps::analyses_of("modes", options);
        apps::check_all(more, *session);
        apps::add_answers(more, *session, modes);
        return std::make_shared<PythonResult>(std::move(session), std::move(modes));
      },
      std::move(progress));
}

std::shared_ptr<PythonResult> PythonScene::analyse(const std::string &name, const apps::OptionTexts &options,
                                                   py::object progress) const
{
  const apps::AnalysisEntry &entry    = apps::analysis_named(name);
  const auto                 analysis = entry.begin();
  apps::AnalysisOutcome      outcome  = apps::AnalysisOutcome::done;
  apps::set_options(*analysis, options);
  const auto result = interruptibly(
      variant_.root,
      [&, self = *this](const apps::Watch &watch)
      {
        auto session = self.session(self.scene(), watch);
        analysis->check(*session);
        auto answer = apps::computed(entry, *analysis, *session, outcome);
        return std::make_shared<PythonResult>(std::move(session), std::move(answer));
      },
      std::move(progress));
  if (outcome == apps::AnalysisOutcome::interrupted)
    raise_with(py::reinterpret_borrow<py::object>(PyExc_KeyboardInterrupt)(), result, py::none());
  if (outcome == apps::AnalysisOutcome::failed)
    raise_with(computation_failed(apps::failure_of(result->result())), result, take_raised(variant_.root));
  return result;
}

std::shared_ptr<apps::StateSpaceModel> PythonScene::state_space(const apps::FrfOptions &options) const
{
  return interruptibly(variant_.root,
                       [&, self = *this](const apps::Watch &watch)
                       {
                         const auto session = self.session(self.scene(), watch);
                         return std::make_shared<apps::StateSpaceModel>(
                             apps::state_space_of(session->scene(), session->machine(), options));
                       });
}

apps::StabilityStudy PythonScene::stability(double step) const
{
  return interruptibly(variant_.root,
                       [&, self = *this](const apps::Watch &watch)
                       {
                         const auto           session = self.session(self.scene(), watch);
                         apps::StabilityStudy study;
                         apps::lay_methods_over(session->scene(), session->machine(), step, apps::method_families(),
                                                study);
                         return study;
                       });
}

std::pair<apps::SizeResult, PythonScene> PythonScene::size(const SizeChoice &choice) const
{
  return interruptibly(variant_.root,
                       [&, self = *this](const apps::Watch &watch)
                       {
                         const Scene scene = self.scene();
                         const auto  sized = [&](const apps::ModelVariant &model)
                         {
                           PythonScene other = self;
                           for (const auto &[key, value] : apps::sized_entries(scene, model))
                             other.variant_.set(key + "=" + value);
                           return other;
                         };
                         apps::SizeOptions options;
                         options.tolerance  = choice.tolerance;
                         options.max_cpu    = choice.max_cpu;
                         options.exhaustive = choice.exhaustive;
                         options.stop       = watch.interruption;
                         const auto found =
                             apps::size_search(scene, apps::budget_outputs(scene, choice.outputs), options);
                         return std::make_pair(found.result, sized(found.chosen));
                       });
}

std::shared_ptr<PythonFullFrame> PythonScene::full_frame() const
{
  return interruptibly(variant_.root,
                       [&, self = *this](const apps::Watch &watch)
                       {
                         auto full = std::make_shared<PythonFullFrame>(PythonFullFrame{
                             assembled(self.scene(), apps::stoppable(watch.progress, watch.interruption))});
                         for (fem::SparseMatrix *A : {&full->frame.M, &full->frame.B, &full->frame.C})
                           A->makeCompressed();
                         return full;
                       });
}

std::shared_ptr<PythonFrame> PythonScene::frame() const
{
  return interruptibly(variant_.root,
                       [&, self = *this](const apps::Watch &watch)
                       {
                         const Scene scene = self.scene();
                         auto        frame = shared_frame(scene, apps::stoppable(watch.progress, watch.interruption));
                         if (!frame)
                           throw std::invalid_argument(scene.frame.place +
                                                       ": the frame of the scene is not reduced; use the matrices of "
                                                       "[frame], or set reduction.method = \"craig-bampton\"");
                         return std::make_shared<PythonFrame>(std::move(frame));
                       });
}

} // namespace gestell::python

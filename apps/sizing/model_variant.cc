#include "apps/sizing/model_variant.h"

#include "apps/scene/build/result_window.h"
#include "apps/scene/variant.h"
#include "apps/session/prepared_machine.h"
#include "apps/sizing/first_modes.h"
#include "coupling/frame/frame_cache.h"
#include "coupling/integration/system/convergence_failure.h"
#include "coupling/modes/modes.h"
#include "coupling/plugin/mesh_service.h"
#include "coupling/reduction/reductions.h"
#include "coupling/simulation/simulation.h"
#include "fem/process/cpu_time.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <variant>

namespace gestell::apps
{

namespace
{

void take_frequencies(const std::vector<coupling::Mode> &modes, const std::vector<OutputName> &outputs,
                      ModelAnswer &answer)
{
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (!outputs[i].of_signal())
    {
      if (outputs[i].mode > int(modes.size())) // a machine may have fewer than modes.number
        throw std::invalid_argument("--outputs: '" + outputs[i].text + "': this model has " +
                                    std::to_string(modes.size()) + " modes");
      answer.sizes[i] = answer.values[i] = modes[std::size_t(outputs[i].mode) - 1].frequency_hz;
      answer.units[i]                    = "Hz";
    }
}

const coupling::SignalSummary &signal_of(const coupling::RunResult &run, const std::string &name)
{
  return *std::find_if(run.signals.begin(), run.signals.end(),
                       [&](const coupling::SignalSummary &signal) { return signal.name == name; });
}

Eigen::VectorXd history_of(const coupling::RunResult &run, const std::string &signal)
{
  const auto width  = Eigen::Index(run.columns.size());
  const auto column = std::find(run.columns.begin(), run.columns.end(), signal) - run.columns.begin();
  return Eigen::Map<const Eigen::MatrixXd>(run.rows.data(), width, Eigen::Index(run.rows.size()) / width)
      .row(column)
      .transpose();
}

void take_run(const coupling::RunResult &run, const std::vector<OutputName> &outputs, double end, ModelAnswer &answer)
{
  answer.method = run.method;
  answer.events = run.events;
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (outputs[i].of_signal())
    {
      const coupling::SignalSummary &signal = signal_of(run, outputs[i].signal);
      answer.values[i]                      = value_of(outputs[i], signal);
      answer.sizes[i]                       = std::max(std::abs(signal.min), std::abs(signal.max));
      answer.units[i]                       = unit_of(outputs[i], signal);
      answer.decided_s[i]                   = decided_at(outputs[i], signal, end);
      answer.histories[i]                   = history_of(run, outputs[i].signal);
    }
}

Eigen::VectorXd ascending(Eigen::VectorXd omega)
{
  std::sort(omega.begin(), omega.end());
  return omega;
}

/// "-frame.cut.columns" is recovered from the motion of the frame, "frame.crown.uz" is that motion.
void take_recovered(const Scene &scene, const coupling::ReducedFrame &frame, const std::vector<OutputName> &outputs,
                    ModelAnswer &answer)
{
  std::set<std::string> recovered;
  for (const fem::FrameOutput &output : frame.outputs)
    for (const char *sign : {"", "-"})
      recovered.insert(std::string(sign) + "frame." + output.name);
  for (const SignalRequest &signal : scene.signals)
  {
    std::vector<std::string> paths = signal.of;
    paths.push_back(signal.path);
    if (std::any_of(paths.begin(), paths.end(), [&](const std::string &path) { return recovered.count(path) > 0; }))
      for (std::size_t i = 0; i < outputs.size(); ++i)
        if (outputs[i].signal == signal.name)
          answer.recovered[i] = true;
  }
}

void take_modes(const Scene &scene, coupling::Machine &small, const std::vector<OutputName> &outputs,
                ModelAnswer &answer)
{
  const bool requested =
      std::any_of(outputs.begin(), outputs.end(), [](const auto &output) { return !output.of_signal(); });
  if (!requested)
    return;
  const auto modes = coupling::linearised_modes(small, modes_configuration(scene, small),
                                                coupling::Linearisation{scene.modes.open}, scene.modes.number);
  take_frequencies(modes, outputs, answer);
}

} // namespace

int modes_asked(const Scene &scene, const ModelAnswer &answer)
{
  return scene.frame.source == FrameSource::parts ? scene.reduction.options.n_modes : answer.modes;
}

int more_than(int modes)
{
  constexpr int least_more = 8; // modes: twice one or two would add next to nothing
  return modes < 0 ? modes : std::max(2 * modes, modes + least_more);
}

int more_modes(const Scene &scene, const ModelAnswer &answer)
{
  const int requested = modes_asked(scene, answer), modes = requested < 0 ? answer.modes : requested;
  return std::min(answer.most_modes, more_than(modes));
}

ModelAnswer::ModelAnswer(std::size_t n, double begin)
    : values(n), sizes(n), units(n), decided_s(n, begin), recovered(n), histories(n)
{
}

ModelAnswer answer_of(const Result &result, const std::vector<OutputName> &outputs)
{
  ModelAnswer answer(outputs.size(), 0.);
  answer.n_frame   = std::max(0, result.model.frame_dofs);
  answer.interface = std::max(0, result.model.interface);
  answer.modes     = result.model.modes;
  answer.most_modes =
      result.model.superposed > 0 ? result.model.superposed : std::max(0, answer.n_frame - answer.interface);
  answer.run_cpu = result.run->wall_s;
  take_run(*result.run, outputs, result.requested.run->end, answer);
  take_frequencies(result.coupled_modes, outputs, answer);
  return answer;
}

namespace
{

void scale(fem::MeshOptions &mesh, double ratio)
{
  mesh.size *= ratio;
  for (auto &[surface, size] : mesh.surface_size)
    size *= ratio;
}

void set_cells(fem::MeshOptions &mesh, Cells cells)
{
  if (cells == Cells::given)
    return;
  mesh.plates = cells == Cells::swept ? fem::Plates::swept : fem::Plates::tetrahedra;
  mesh.curved = cells == Cells::curved;
}

/// Of parts: those that are swept stay so.
bool is_tetrahedra(const fem::MeshOptions &mesh)
{
  return mesh.plates == fem::Plates::tetrahedra;
}

} // namespace

Scene varied(const Scene &scene, const ModelVariant &variant)
{
  Scene other = scene;
  scale(other.frame.geometry.mesh, variant.mesh);
  set_cells(other.frame.geometry.mesh, variant.cells);
  if (variant.most_cells > 0.)
    other.frame.geometry.mesh.max_cells = std::min(other.frame.geometry.mesh.max_cells, variant.most_cells);
  for (coupling::FramePart &part : other.frame.parts.parts)
  {
    scale(part.geometry.mesh, variant.mesh);
    if (is_tetrahedra(part.geometry.mesh))
      set_cells(part.geometry.mesh, variant.cells);
  }
  other.frame.parts.all_modes |= variant.modes >= 0; // each part has as many as are asked for
  for (const coupling::ReductionEntry &entry : coupling::Reductions::entries())
    if (entry.name == variant.reduction)
    {
      other.reduction.method      = entry.name;
      other.reduction.makes_frame = entry.makes == coupling::ReductionEntry::Makes::reduced_frame;
      other.reduction.superposition.reset();
      if (entry.makes == coupling::ReductionEntry::Makes::modes_of_machine)
        other.reduction.superposition.emplace().place = other.reduction.options.place;
      if (other.reduction.makes_frame)
        other.reduction.options.method = entry.name;
    }
  if (variant.modes >= 0 && other.reduction.superposition)
    other.reduction.superposition->n_modes = variant.modes;
  else if (variant.modes >= 0)
    other.reduction.options.n_modes = variant.modes;
  if (variant.method)
  {
    other.run.options.method = *variant.method;
    other.run.step_given     = true;
  }
  return other;
}

namespace
{

/// Whether the first modes of the reduction are those that it has with fewer.
bool is_nested(const Scene &scene)
{
  return frame_path(scene) == FramePath::reduce && scene.frame.source != FrameSource::parts &&
         !scene.reduction.superposition && scene.reduction.method == "craig-bampton" &&
         !scene.reduction.options.inertia_relief;
}

/// A frame in elements of degree three is kept in the cache as others are.
coupling::CachedFrame raised_frame(Scene &scene)
{
  fem::FrameSpecification &frame = scene.frame.geometry;
  frame.stress                   = false;
  coupling::FrameOrigin origin   = frame_origin(scene);
  origin.recipe.push_back({"degree", "3"});
  return coupling::cached_or_made(
      origin, [&] { return coupling::mesh_service().reduce_raised(frame, scene.reduction.options, {}); });
}

/// The scene on its frame.  @param cpu  [s] that it took; a cached frame counts with the CPU time of its reduction
PreparedMachine prepare(Scene &scene, const ModelVariant &variant, double &cpu)
{
  const bool nested = variant.modes >= 0 && variant.made > variant.modes && is_nested(scene);
  Scene      making = scene;
  if (nested)
    making.reduction.options.n_modes = variant.made;
  const bool            reduced = variant.raised || frame_path(scene) == FramePath::reduce;
  coupling::CachedFrame made;
  try
  {
    if (reduced)
      made = variant.raised ? raised_frame(making) : reduced_frame(making, {});
  }
  catch (const std::invalid_argument &failure)
  {
    throw FrameFailure(failure.what());
  }
  const double begin = fem::cpu_time();
  if (nested)
    made.frame = with_first_modes(std::move(made.frame), variant.modes);
  PreparedMachine prepared = prepare_machine(scene, {}, reduced ? &made.frame : nullptr);
  keep_stable_step(prepared, scene.run);
  cpu = made.cpu + fem::cpu_time() - begin;
  return prepared;
}

} // namespace

ModelAnswer answer_of(const Scene &scene, const ModelVariant &variant, const std::vector<OutputName> &outputs,
                      const std::atomic<bool> *stop)
{
  Scene other = varied(scene, variant);
  if (variant.raised)
    keep_signals(other, signals_of(outputs));
  ModelAnswer     answer(outputs.size(), other.run.options.begin);
  PreparedMachine prepared = prepare(other, variant, answer.prepare_cpu);
  if (const coupling::ReducedFrame *frame = prepared.small().model().reduced_frame())
  {
    answer.n_frame    = frame->n_full;
    answer.interface  = frame->n_interface;
    answer.modes      = int(frame->M.rows()) - frame->n_interface;
    answer.most_modes = answer.n_frame - answer.interface;
    answer.whole      = prepared.companion && !prepared.in_modes;
    take_recovered(other, *frame, outputs, answer);
    answer.superposed = prepared.in_modes != nullptr;
    answer.omega      = ascending(answer.superposed ? prepared.machine.superposed_frequencies() : frame->omega0);
    if (answer.superposed)
    {
      answer.interface  = 0;
      answer.modes      = prepared.machine.size();
      answer.most_modes = int(prepared.in_modes->projection.cols());
    }
  }
  take_modes(other, prepared.small(), outputs, answer);
  const double ready = fem::cpu_time();
  if (std::any_of(outputs.begin(), outputs.end(), [](const OutputName &output) { return output.of_signal(); }))
  {
    const coupling::InitialState initial = prepare_start(other, prepared);
    require_free_motion(other, prepared.machine, initial);
    coupling::RunOptions options = other.run.options;
    options.from                 = result_window(other, prepared.machine, initial);
    const auto run =
        coupling::simulate(prepared.machine, initial, options, scene_signals(other, prepared.machine), {}, stop);
    if (run.interrupted || !run.failure.empty())
      throw coupling::ConvergenceFailure(run.interrupted ? "interrupted" : run.failure);
    take_run(run, outputs, other.run.options.end, answer);
  }
  answer.run_cpu = fem::cpu_time() - ready;
  return answer;
}

namespace
{

std::string key_of(const coupling::MethodOptions &method)
{
  std::string key = method.method + '|' + std::to_string(method.order) + '|' + exact_text(method.step) + '|' +
                    exact_text(method.tolerance) + '|' + std::to_string(method.max_halvings) + '|' +
                    exact_text(method.newton.tolerance) + '|' + exact_text(method.newton.share_of_error);
  for (const auto &[name, value] : method.own)
    key += '|' + name + '=' +
           (std::holds_alternative<double>(value) ? exact_text(std::get<double>(value)) : std::get<std::string>(value));
  return key;
}

std::string key_of(const ModelVariant &model)
{
  return exact_text(model.mesh) + '|' + std::to_string(model.modes) + '|' + model.reduction + '|' +
         std::to_string(int(model.cells)) + std::to_string(model.raised) + '|' +
         std::to_string(std::max(model.modes, model.made)) + '|' + exact_text(model.most_cells) + '|' +
         (model.method ? key_of(*model.method) : "");
}

} // namespace

const ModelAnswer &ModelAnswers::of(const ModelVariant &model)
{
  const std::string key = key_of(model);
  if (const auto found = known_.find(key); found != known_.end())
    return found->second;
  if (const auto found = failed_.find(key); found != failed_.end())
    std::rethrow_exception(found->second);
  try
  {
    const ModelAnswer answer = answer_of(scene_, model, outputs_, stop_);
    if (stop_ && *stop_)
      throw coupling::ConvergenceFailure("interrupted");
    return known_[key] = answer;
  }
  catch (const std::exception &)
  {
    if (!stop_ || !*stop_)
      failed_[key] = std::current_exception();
    throw;
  }
}

void ModelAnswers::know(const ModelVariant &model, const ModelAnswer &answer)
{
  known_[key_of(model)] = answer;
}

coupling::MethodOptions finest_method(const Scene &scene)
{
  const coupling::RunOptions &run    = scene.run.options;
  coupling::MethodOptions     finest = coupling::options_of("exact", 8);
  finest.max_halvings                = run.method.max_halvings;
  if (run.method.newton.share_of_error == 0.) // the scene gives newton_tolerance
    finest.newton = {std::min(run.method.newton.tolerance, finest.newton.tolerance), finest.newton.max_iterations,
                     finest.newton.joints, 0.};
  if (run.method.method == finest.method)
    finest.own = run.method.own;
  finest.set("force", std::string("collocation"));
  finest.tolerance             = 1e-10;
  constexpr double least_steps = 50.; // of the run
  // A fixed step says nothing of the longest one; no load goes by between two steps.
  finest.step = controlled(run.method) ? run.method.step : (run.end - run.begin) / least_steps;
  for (const LoadRequest &load : scene.loads)
    for (const auto &harmonic : load.oscillations)
      if (harmonic.omega > 0. && !controlled(run.method))
        finest.step = std::min(finest.step, 0.25 * M_PI / harmonic.omega);
  return finest;
}

coupling::MethodOptions finer_method(const coupling::MethodOptions &given)
{
  coupling::MethodOptions finer = given;
  if (controlled(given))
    finer.tolerance /= 16.;
  else
    finer.step /= 2.;
  return finer;
}

std::vector<std::string> signal_names(const Scene &scene)
{
  std::vector<std::string> names;
  for (const SignalRequest &signal : scene.signals)
    names.push_back(signal.name);
  return names;
}

} // namespace gestell::apps

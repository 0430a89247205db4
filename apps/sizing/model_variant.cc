#include "apps/sizing/model_variant.h"

#include "apps/session/prepared_machine.h"
#include "coupling/frame/frame_cache.h"
#include "coupling/integration/system/convergence_failure.h"
#include "coupling/modes/modes.h"
#include "coupling/plugin/mesh_service.h"
#include "coupling/reduction/reductions.h"
#include "coupling/simulation/simulation.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <mutex>
#include <stdexcept>
#include <variant>

namespace gestell::apps
{

namespace
{

/// [Hz] of a mode that is asked for; a machine may have fewer than modes.number.
template <typename Modes>
double frequency_of(const OutputName &output, const Modes &modes)
{
  if (output.mode > int(modes.size()))
    throw std::invalid_argument("--outputs: '" + output.text + "': this model has " + std::to_string(modes.size()) +
                                " modes");
  return modes[std::size_t(output.mode) - 1].frequency_hz;
}

constexpr double least_steps = 50.;
constexpr int    least_more  = 8; ///< modes

/// [s] of the processor that this process took so far.
double cpu_now()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

const coupling::SignalSummary &signal_of(const coupling::RunResult &run, const std::string &name)
{
  return *std::find_if(run.signals.begin(), run.signals.end(),
                       [&](const coupling::SignalSummary &signal) { return signal.name == name; });
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
    }
}

void take_modes(const Scene &scene, coupling::Machine &small, const std::vector<OutputName> &outputs,
                ModelAnswer &answer)
{
  const bool asked =
      std::any_of(outputs.begin(), outputs.end(), [](const auto &output) { return !output.of_signal(); });
  if (!asked)
    return;
  const auto modes = coupling::linearised_modes(small, modes_configuration(scene, small),
                                                coupling::Linearisation{scene.modes.open}, scene.modes.number);
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (!outputs[i].of_signal())
    {
      answer.sizes[i] = answer.values[i] = frequency_of(outputs[i], modes);
      answer.units[i]                    = "Hz";
    }
}

} // namespace

int modes_asked(const Scene &scene, const ModelAnswer &answer)
{
  return scene.frame.source == FrameSource::parts ? scene.reduction.options.n_modes : answer.modes;
}

int more_modes(const Scene &scene, const ModelAnswer &answer)
{
  const int asked = modes_asked(scene, answer), modes = asked < 0 ? answer.modes : asked;
  return std::min(answer.most_modes, std::max(2 * modes, modes + least_more));
}

ModelAnswer answer_of(const Result &result, const std::vector<OutputName> &outputs)
{
  ModelAnswer answer;
  answer.values.resize(outputs.size());
  answer.sizes.resize(outputs.size());
  answer.units.resize(outputs.size());
  answer.decided_s.resize(outputs.size());
  answer.n_frame   = std::max(0, result.model.frame_dofs);
  answer.interface = std::max(0, result.model.interface);
  answer.modes     = result.model.modes;
  answer.most_modes =
      result.model.superposed > 0 ? result.model.superposed : std::max(0, answer.n_frame - answer.interface);
  answer.run_cpu = result.run->wall_s;
  take_run(*result.run, outputs, result.asked.run->end, answer);
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (!outputs[i].of_signal())
    {
      answer.sizes[i] = answer.values[i] = frequency_of(outputs[i], result.coupled_modes);
      answer.units[i]                    = "Hz";
    }
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

bool is_meshed(const std::string &cad)
{
  const std::string kind = cad.substr(std::min(cad.rfind('.'), cad.size()));
  return kind != ".msh" && kind != ".inp" && kind != ".stl";
}

bool may_curve(const fem::MeshOptions &mesh)
{
  return mesh.plates == fem::Plates::tetrahedra;
}

bool is_straight(const fem::MeshOptions &mesh)
{
  return may_curve(mesh) && !mesh.curved;
}

} // namespace

Scene varied(const Scene &scene, const ModelVariant &variant)
{
  Scene other = scene;
  scale(other.frame.geometry.mesh, variant.mesh);
  if (variant.swept)
    other.frame.geometry.mesh.plates = fem::Plates::swept;
  for (coupling::FramePart &part : other.frame.parts.parts)
  {
    scale(part.geometry.mesh, variant.mesh);
    part.geometry.mesh.curved |= variant.curved && may_curve(part.geometry.mesh);
  }
  other.frame.geometry.mesh.curved |= variant.curved && may_curve(other.frame.geometry.mesh);
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

/// On the frame in elements of degree three, which is kept in the cache as others are.
PreparedMachine prepare_raised(Scene &scene)
{
  fem::FrameSpecification &frame = scene.frame.geometry;
  frame.stress                   = false;
  coupling::FrameOrigin origin   = frame_origin(scene);
  origin.recipe.push_back({"degree", "3"});
  const auto raised = coupling::cached_or_made(
      origin, [&] { return coupling::mesh_service().reduce_raised(frame, scene.reduction.options, {}); });
  PreparedMachine prepared = prepare_machine_on(scene, raised.frame);
  prepared.from_cache      = raised.from_cache;
  return prepared;
}

/// [s] A frame that was made before in this process has cost what it did, though it now comes from the cache.
double preparation(const Scene &scene, const ModelVariant &variant, const PreparedMachine &prepared, double taken)
{
  static std::map<std::string, double> made;
  static std::mutex                    one;
  if (frame_path(scene) != FramePath::reduce)
    return taken;
  const std::lock_guard<std::mutex> alone(one);
  double &cpu = made[coupling::content_key(frame_origin(scene).recipe) + (variant.raised ? "raised" : "")];
  return cpu  = prepared.from_cache ? std::max(cpu, taken) : taken;
}

/// No others, which may read what a model does not tell.
void keep_signals_of(const std::vector<OutputName> &outputs, Scene &scene)
{
  const auto unread = [&](const SignalRequest &signal)
  {
    return std::none_of(outputs.begin(), outputs.end(),
                        [&](const OutputName &output) { return output.signal == signal.name; });
  };
  scene.signals.erase(std::remove_if(scene.signals.begin(), scene.signals.end(), unread), scene.signals.end());
}

} // namespace

ModelAnswer answer_of(const Scene &scene, const ModelVariant &variant, const std::vector<OutputName> &outputs,
                      const std::atomic<bool> *stop)
{
  Scene other = varied(scene, variant);
  if (variant.raised)
    keep_signals_of(outputs, other);
  ModelAnswer answer;
  answer.values.resize(outputs.size());
  answer.sizes.resize(outputs.size());
  answer.units.resize(outputs.size());
  answer.decided_s.assign(outputs.size(), other.run.options.begin);
  const double    begin    = cpu_now();
  PreparedMachine prepared = variant.raised ? prepare_raised(other) : prepare_machine(other);
  keep_stable_step(prepared, other.run);
  answer.from_cache  = prepared.from_cache;
  answer.prepare_cpu = preparation(other, variant, prepared, cpu_now() - begin);
  if (const coupling::ReducedFrame *frame = prepared.small().model().reduced_frame())
  {
    answer.n_frame    = frame->n_full;
    answer.interface  = frame->n_interface;
    answer.modes      = int(frame->M.rows()) - frame->n_interface;
    answer.most_modes = answer.n_frame - answer.interface;
    answer.whole      = prepared.companion && !prepared.in_modes;
    if (prepared.in_modes)
    {
      answer.interface  = 0;
      answer.modes      = prepared.machine.size();
      answer.most_modes = int(prepared.in_modes->projection.cols());
      answer.cutoff_hz  = prepared.machine.superposed_frequencies().maxCoeff() / (2. * M_PI);
    }
    else if (frame->omega0.size() > 0)
      answer.cutoff_hz = frame->omega0.maxCoeff() / (2. * M_PI);
  }
  take_modes(other, prepared.small(), outputs, answer);
  const double ready = cpu_now();
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
  answer.run_cpu = cpu_now() - ready;
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
         std::to_string(model.swept) + std::to_string(model.raised) + std::to_string(model.curved) + '|' +
         (model.method ? key_of(*model.method) : "");
}

} // namespace

const ModelAnswer &ModelAnswers::of(const ModelVariant &model)
{
  const std::string key = key_of(model);
  if (const auto found = known_.find(key); found != known_.end())
    return found->second;
  if (const auto found = failed_.find(key); found != failed_.end())
    throw std::invalid_argument(found->second);
  const double begin = cpu_now();
  try
  {
    const ModelAnswer answer = answer_of(scene_, model, outputs_, stop_);
    cpu_s_ += cpu_now() - begin;
    if (stop_ && *stop_)
      throw coupling::ConvergenceFailure("interrupted");
    return known_[key] = answer;
  }
  catch (const std::exception &failure)
  {
    if (!stop_ || !*stop_)
      failed_[key] = failure.what();
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
  finest.tolerance = 1e-10;
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

bool mesh_is_made(const Scene &scene)
{
  return scene.frame.source == FrameSource::geometry && is_meshed(scene.frame.geometry.cad);
}

bool meshes_of_parts_are_made(const Scene &scene)
{
  const auto &parts = scene.frame.parts.parts;
  return scene.frame.source == FrameSource::parts &&
         std::all_of(parts.begin(), parts.end(),
                     [](const coupling::FramePart &part) { return is_meshed(part.geometry.cad); });
}

bool mesh_can_change(const Scene &scene)
{
  return mesh_is_made(scene) || meshes_of_parts_are_made(scene);
}

bool sides_can_curve(const Scene &scene)
{
  const auto &parts = scene.frame.parts.parts;
  return mesh_is_made(scene)
             ? is_straight(scene.frame.geometry.mesh)
             : meshes_of_parts_are_made(scene) &&
                   std::any_of(parts.begin(), parts.end(),
                               [](const coupling::FramePart &part) { return is_straight(part.geometry.mesh); });
}

bool modes_are_chosen(const Scene &scene)
{
  return scene.reduction.superposition || (frame_path(scene) == FramePath::reduce && scene.reduction.method != "guyan");
}

std::vector<std::string> signal_names(const Scene &scene)
{
  std::vector<std::string> names;
  for (const SignalRequest &signal : scene.signals)
    names.push_back(signal.name);
  return names;
}

} // namespace gestell::apps

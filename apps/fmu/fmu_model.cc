#include "apps/fmu/fmu_model.h"

#include "apps/scene/build/build_machine.h"
#include "apps/scene/file/scene_file.h"
#include "apps/scene/file/toml_text.h"
#include "apps/scene/file/written_text.h"
#include "apps/scene/variant.h"
#include "coupling/frame/reduced_frame_file.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// The frame in the archive. It is not reduced here: the host may have threads that a child process would lose.
coupling::ReducedFrame frame_at_hand(const Scene &scene)
{
  try
  {
    return coupling::read_stored_frame(scene.frame.reduced_file).frame;
  }
  catch (const std::runtime_error &failure)
  {
    throw std::invalid_argument(scene.frame.reduced_file + ": " + failure.what() + "; export the FMU again");
  }
}

coupling::Machine machine_at_hand(const Scene &scene)
{
  switch (frame_path(scene))
  {
  case FramePath::none:
  case FramePath::dense:
    return build_machine(scene);
  case FramePath::from_file:
    return build_machine(scene, frame_at_hand(scene));
  default:
    throw std::invalid_argument(scene.file + ": its frame is not reduced; export the FMU again");
  }
}

std::string with_point(double value)
{
  std::string text = exact_text(value);
  if (text.find_first_of(".en") == std::string::npos)
    text += ".0";
  return text;
}

/// Key of the parameter in the scene; names in [parameters] have no dots.
std::string key_of(const FmuVariable &parameter)
{
  return (parameter.name.find('.') == std::string::npos ? "parameters." : "") + parameter.name;
}

void require_finite(double value, const std::string &name)
{
  if (!std::isfinite(value))
    throw std::invalid_argument("'" + name + "' is set to " + exact_text(value) + "; it needs a finite number");
}

} // namespace

std::string FmuResources::text() const
{
  std::string names;
  for (const std::string &name : frozen)
    names += (names.empty() ? "" : ", ") + written_text(name);
  return "guid = " + written_text(guid) + "\nfrozen = [" + names + "]\n";
}

FmuResources FmuResources::read(const std::filesystem::path &folder)
{
  const std::string path = (folder / "fmu.toml").string();
  const SceneNode   root = parse_toml_file(path), *guid = root.find("guid"), *frozen = root.find("frozen");
  if (!guid || !frozen)
    throw std::invalid_argument(path + ": needs 'guid' and 'frozen'; it was changed after gestell export");
  FmuResources resources{guid->text, {}};
  for (const SceneNode &name : frozen->elements)
    resources.frozen.insert(name.text);
  return resources;
}

FmuModel::FmuModel(const std::filesystem::path &folder)
    : folder_(folder), root_(read_scene_file((folder / "scene.toml").string(), {})),
      resources_(FmuResources::read(folder))
{
  build();
  interface_ = fmu_interface(root_, scene_, *machine_, resources_.frozen);
  reset();
}

void FmuModel::build()
{
  Variant variant{root_, (folder_ / "scene.toml").string()};
  for (std::size_t i = 0; i < parameters_.size(); ++i)
    if (const FmuVariable &variable = interface_.parameters[i]; parameters_[i] != variable.start)
      variant.set(key_of(variable) + "=" + with_point(parameters_[i]));
  scene_ = variant.scene();
  require_run(scene_);
  handles_ = scene_inputs(scene_);
  machine_.emplace(machine_at_hand(scene_));
}

void FmuModel::reset()
{
  run_.reset();
  parameters_.clear();
  inputs_.clear();
  for (const FmuVariable &variable : interface_.parameters)
    parameters_.push_back(variable.start);
  for (const FmuVariable &variable : interface_.inputs)
    inputs_.push_back(variable.start);
  rates_.assign(inputs_.size(), 0.);
  since_.assign(inputs_.size(), scene_.run.options.begin);
}

void FmuModel::set_parameter(std::size_t i, double value)
{
  const std::string &name = interface_.parameters[i].name;
  require_finite(value, name);
  if (run_)
    throw std::invalid_argument("the parameter '" + name +
                                "' is fixed once the machine has started; reset the FMU to set it");
  parameters_[i] = value;
}

double FmuModel::input(std::size_t i) const
{
  return inputs_[i] + rates_[i] * (time() - since_[i]);
}

void FmuModel::set_input(std::size_t i, double value)
{
  require_finite(value, interface_.inputs[i].name);
  if (since_[i] != time())
    rates_[i] = 0.;
  inputs_[i] = value;
  since_[i]  = time();
}

void FmuModel::set_input_rate(std::size_t i, double rate)
{
  require_finite(rate, interface_.inputs[i].name);
  inputs_[i] = input(i);
  rates_[i]  = rate;
  since_[i]  = time();
}

/// True: an input jumps or bends here.
bool FmuModel::apply_inputs()
{
  bool jump = false;
  for (std::size_t i = 0; i < inputs_.size(); ++i)
    for (const auto &handle : handles_[i].second)
    {
      const double now = input(i), before = handle->at(time());
      const double rounding = 4. * std::numeric_limits<double>::epsilon() * std::max(std::abs(now), std::abs(before));
      jump                  = jump || std::abs(now - before) > rounding || rates_[i] != handle->rate;
      handle->value         = inputs_[i];
      handle->rate          = rates_[i];
      handle->since         = since_[i];
    }
  return jump;
}

void FmuModel::start()
{
  if (run_)
    return;
  build();
  apply_inputs();
  const coupling::InitialState initial = initial_state(scene_, *machine_);
  require_free_motion(scene_, *machine_, initial);
  run_ =
      std::make_unique<coupling::SteppedRun>(*machine_, initial, scene_.run.options, scene_signals(scene_, *machine_));
}

double FmuModel::output(std::size_t i)
{
  start();
  return run_->values()[i];
}

double FmuModel::time() const
{
  return run_ ? run_->time() : scene_.run.options.begin;
}

std::string FmuModel::ended() const
{
  return run_ ? run_->ended() : "";
}

void FmuModel::step(double t, double length)
{
  start();
  if (!run_->is_now(t))
    throw std::invalid_argument("the step begins at " + exact_text(t) + " s, but the machine is at " +
                                exact_text(time()) +
                                " s; steps must follow each other (restore a saved state to go back)");
  if (!(length > 0.) || !std::isfinite(length))
    throw std::invalid_argument("the step is " + exact_text(length) + " s long; its length must be above zero");
  if (apply_inputs())
    run_->load_jumped();
  run_->go_on_to(t + length);
}

void FmuModel::verify() const
{
  if (run_)
    run_->verify();
}

std::string FmuModel::finish(const std::string &failure, const std::string &id)
{
  return run_ ? run_->finish(failure, id) : "";
}

std::vector<coupling::Finding> FmuModel::take_findings()
{
  return run_ ? run_->take_findings() : std::vector<coupling::Finding>();
}

std::vector<coupling::Event> FmuModel::take_events()
{
  return run_ ? run_->take_events() : std::vector<coupling::Event>();
}

FmuState FmuModel::state()
{
  FmuState state{resources_.guid, parameters_, inputs_, rates_, since_, {}};
  if (run_)
    state.motion = run_->state();
  return state;
}

void FmuModel::require_own(const FmuState &state) const
{
  if (state.guid != resources_.guid)
    throw std::invalid_argument("the state is that of another FMU, with the guid '" + state.guid + "'; this one is '" +
                                resources_.guid + "'");
  if (state.parameters.size() != parameters_.size() || state.inputs.size() != inputs_.size() ||
      state.rates.size() != inputs_.size() || state.since.size() != inputs_.size())
    throw std::invalid_argument("the state is damaged: it has " + std::to_string(state.parameters.size()) +
                                " parameters and " + std::to_string(state.inputs.size()) + " inputs, this one " +
                                std::to_string(parameters_.size()) + " and " + std::to_string(inputs_.size()));
}

void FmuModel::restore(const FmuState &state)
{
  require_own(state);
  if (!state.motion || state.parameters != parameters_)
    run_.reset();
  parameters_ = state.parameters;
  inputs_     = state.inputs;
  rates_      = state.rates;
  since_      = state.since;
  if (!state.motion)
    return;
  start();
  apply_inputs();
  if (state.motion->q.size() != machine_->size() || state.motion->v.size() != machine_->size() ||
      state.motion->history.size() != machine_->events().save_history().size())
    throw std::invalid_argument("the state is damaged: it has " + std::to_string(state.motion->q.size()) +
                                " DOFs, this one " + std::to_string(machine_->size()));
  run_->restore(*state.motion);
}

} // namespace gestell::apps

#include "apps/sizing/error_budget.h"

#include "apps/scene/build/build_machine.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::apps
{

namespace
{

constexpr double coarser    = 1.5;  ///< size of the cells of the second mesh
constexpr double mesh_order = 1.5;  ///< in their size
constexpr double hardly     = 1.1;  ///< ratio of sizes below which two meshes are alike
constexpr double left_over  = 1.25; ///< of what degree three corrects, docs/theory/mesh_error.md (4b)
constexpr int    most_raised =
    60000; ///< coordinates of a mesh that is compared with degree three, which has three times as many
constexpr int    coarsest_raised = 3; ///< powers of the ratio of sizes
constexpr double no_part         = 0.;

using Differs = std::optional<std::string>; ///< the event in which two models differ; none: in none

std::string event_text(const coupling::Event &event)
{
  return event.name + " " + event.kind;
}

/// The first event by which `b` differs from `a` up to the time t of a, each element by itself: where those of two
/// elements change places, the motion changes by as little as their times.
Differs differing_event(const ModelAnswer &a, const ModelAnswer &b, double t)
{
  std::map<std::string, std::vector<coupling::Event>> others;
  std::map<std::string, std::size_t>                  seen;
  for (const coupling::Event &event : b.events)
    others[event.name].push_back(event);
  for (const coupling::Event &event : a.events)
  {
    if (event.t > t)
      break;
    const std::vector<coupling::Event> &other = others[event.name];
    const std::size_t                   k     = seen[event.name]++;
    if (k >= other.size())
      return event_text(event) + " at " + short_text(event.t) + " s is missing";
    if (event.kind != other[k].kind)
      return event_text(event) + " at " + short_text(event.t) + " s becomes " + event_text(other[k]) + " at " +
             short_text(other[k].t) + " s";
  }
  return {};
}

/// A second model that differs in one part, or why there is none.
struct SecondModel
{
  std::optional<ModelAnswer> answer;
  std::optional<ModelAnswer> first;         ///< that it differs from; none: the scene's own
  double                     factor = 1.;   ///< from the difference of two values to the error of the first
  std::string                reason;        ///< what the second model is; without one why
  bool                       exact = false; ///< there is nothing to err
};

class BudgetMaker
{
public:
  BudgetMaker(ModelAnswers &models, const ModelVariant &model, const BudgetParts &parts)
      : models_(models), model_(model), parts_(parts), scene_(varied(models.scene(), model)),
        outputs_(models.outputs()), run_(models.of(model)), stop_(models.stop())
  {
  }

  ErrorBudget make();

private:
  /// This model by the method of the models that differ in mesh and modes.
  ModelVariant model() const
  {
    ModelVariant variant = model_;
    if (method_)
      variant.method = method_;
    return variant;
  }
  ModelVariant with_modes(int modes, double size = 1.) const
  {
    ModelVariant variant = model();
    variant.mesh *= size;
    if (modes >= 0)
      variant.modes = modes;
    return variant;
  }
  ModelAnswer answer(const ModelVariant &variant) const { return models_.of(variant); }
  /// Of the scene's frame with another integration; what fails is a reason.
  SecondModel finer_in_time();
  SecondModel finer_in_modes();
  SecondModel curved_in_mesh();
  SecondModel other_in_mesh(bool curved);
  SecondModel raised_in_mesh(bool curved);
  SecondModel coarser_in_mesh();
  template <typename Make>
  SecondModel tried(const Make &make) const;
  BudgetPart part_of(std::size_t output, const ModelAnswer &first, const SecondModel &second, BudgetEntry &entry) const;

  ModelAnswers                          &models_;
  const ModelVariant                     model_;
  const BudgetParts                      parts_;
  const Scene                            scene_; ///< of the model
  const std::vector<OutputName>         &outputs_;
  const ModelAnswer                      run_;
  const std::atomic<bool>               *stop_;
  std::optional<coupling::MethodOptions> method_;    ///< of the models that differ in mesh and modes
  ModelAnswer                            reference_; ///< the scene's model by that method
  std::optional<ModelAnswer>             curved_;    ///< and with sides that follow the geometry, where it has not
};

SecondModel unasked()
{
  SecondModel none;
  none.reason = "not asked for";
  return none;
}

template <typename Make>
SecondModel BudgetMaker::tried(const Make &make) const
{
  try
  {
    return make();
  }
  catch (const std::exception &failure)
  {
    if (stop_ && *stop_)
      throw;
    SecondModel none;
    none.reason = std::string("the second model failed: ") + failure.what();
    return none;
  }
}

SecondModel BudgetMaker::finer_in_time()
{
  reference_ = run_;
  try
  {
    SecondModel second;
    method_       = finest_method(scene_);
    second.answer = answer(model());
    second.reason = "against " + second.answer->method;
    reference_    = *second.answer;
    return second;
  }
  catch (const std::exception &)
  {
    if (stop_ && *stop_)
      throw;
    method_.reset();
  }
  if (!parts_.time)
    return unasked();
  return tried(
      [&]
      {
        const coupling::MethodOptions &given = scene_.run.options.method;
        SecondModel                    second;
        ModelVariant                   finer = model_;
        finer.method                         = finer_method(given);
        second.answer                        = answer(finer);
        const double power                   = controlled(given) ? 16. : std::pow(2., std::max(1, given.order));
        second.factor                        = power / (power - 1.);
        second.reason = controlled(given) ? "against a sixteenth of the tolerance" : "against half the step";
        return second;
      });
}

SecondModel BudgetMaker::finer_in_modes()
{
  SecondModel second;
  if (frame_path(scene_) == FramePath::from_file)
  {
    second.reason = "the frame was reduced elsewhere; only who has the whole frame can tell";
    return second;
  }
  if (!modes_are_chosen(scene_) && scene_.reduction.method != "guyan")
  {
    second.exact  = true;
    second.reason = "the frame is not reduced";
    return second;
  }
  const int most = run_.most_modes;
  if (run_.modes >= most)
  {
    second.exact  = true;
    second.reason = "all modes are kept";
    return second;
  }
  return tried(
      [&]
      {
        const int    m    = more_modes(scene_, run_);
        ModelVariant more = with_modes(m);
        if (!modes_are_chosen(scene_)) // of statics alone
          more.reduction = "craig-bampton";
        second.answer = answer(more);
        second.reason = "against " + std::to_string(m) + " modes";
        return second;
      });
}

SecondModel BudgetMaker::coarser_in_mesh()
{
  SecondModel second;
  if (scene_.frame.source == FrameSource::none || scene_.frame.source == FrameSource::matrices)
  {
    second.exact  = true;
    second.reason = scene_.frame.source == FrameSource::none ? "there is no frame" : "the matrices are the frame";
    return second;
  }
  if (!mesh_can_change(scene_))
  {
    second.reason = "the mesh comes from a file and cannot be made coarser";
    return second;
  }
  return tried(
      [&]
      {
        const bool   parts = scene_.frame.source == FrameSource::parts; // their second reduction stays as it is
        ModelAnswer  other = answer(with_modes(parts ? -1 : modes_asked(scene_, run_), coarser));
        const double ratio = std::cbrt(double(run_.n_frame) / other.n_frame);
        second.reason      = "against cells of 1.5 times the size";
        if (ratio < hardly)
          second.reason = "cells of 1.5 times the size give nearly the same mesh: small features decide its size";
        else
        {
          second.answer = std::move(other);
          second.factor = 1. / (std::pow(ratio, mesh_order) - 1.);
        }
        return second;
      });
}

/// What straight sides cut off curved faces: the same cells with sides that follow these.  It falls with no finer mesh
/// while no circle has fewer sides than a mesh gives each, so it is no part of what two sizes of cells tell.
SecondModel BudgetMaker::curved_in_mesh()
{
  SecondModel second;
  second.exact = true;
  if (!sides_can_curve(scene_))
    return second;
  try
  {
    ModelVariant variant = with_modes(scene_.frame.source == FrameSource::parts ? -1 : modes_asked(scene_, run_));
    variant.curved       = true;
    second.answer        = answer(variant);
    second.exact         = false;
    second.reason        = "against sides that follow the geometry";
    return second;
  }
  catch (const std::exception &failed) // such as cells that sides along the geometry turn inside out
  {
    if (stop_ && *stop_)
      throw;
    second.reason = std::string("straight sides at curved faces are not judged: ") + failed.what();
    return second;
  }
}

/// Of the mesh itself in elements of degree three, or of a coarser one whose error is reckoned to this one; both with
/// sides that follow the geometry where the model with such sides is at hand.
SecondModel BudgetMaker::raised_in_mesh(bool curved)
{
  ModelAnswer first = curved ? *curved_ : reference_;
  double      size  = 1.;
  for (int k = 0; k <= coarsest_raised; ++k, size *= coarser)
  {
    if (k > 0 && !mesh_can_change(scene_))
      break;
    ModelVariant variant = with_modes(run_.modes, size);
    variant.curved |= curved;
    if (k > 0)
      first = answer(variant);
    if (first.n_frame > most_raised)
      continue;
    variant.raised = true;
    SecondModel second;
    second.answer = answer(variant);
    second.factor = left_over / std::pow(std::cbrt(double(run_.n_frame) / first.n_frame), mesh_order);
    second.reason = "against elements of degree three" +
                    (k > 0 ? " in cells of " + short_text(size, 3) + " times the size" : std::string());
    second.first = std::move(first);
    return second;
  }
  return {};
}

SecondModel BudgetMaker::other_in_mesh(bool curved)
{
  if (scene_.frame.source == FrameSource::geometry && !run_.whole && !scene_.reduction.superposition)
    try
    {
      if (SecondModel second = raised_in_mesh(curved); second.answer)
        return second;
    }
    catch (const std::exception &) // such as an output that degree three does not tell
    {
      if (stop_ && *stop_)
        throw;
    }
  return coarser_in_mesh();
}

BudgetPart BudgetMaker::part_of(std::size_t output, const ModelAnswer &given, const SecondModel &second,
                                BudgetEntry &entry) const
{
  const ModelAnswer &first = second.first ? *second.first : given;
  if (second.exact)
    return {no_part, second.reason};
  if (!second.answer)
    return {std::nullopt, second.reason};
  const double v = first.values[output], w = second.answer->values[output];
  for (const double value : {v, w})
    entry.bracket = {std::min(entry.bracket->first, value), std::max(entry.bracket->second, value)};
  if (outputs_[output].of_signal())
    if (const Differs event = differing_event(first, *second.answer, first.decided_s[output]))
      return {std::nullopt, "the order of events changes, " + second.reason + ": " + *event};
  return {second.factor * std::abs(v - w), second.reason};
}

/// Of two causes; nothing is known where it is not of one of them.
BudgetPart sum(const BudgetPart &a, const BudgetPart &b)
{
  if (!a.error || !b.error)
    return a.error ? b : a;
  const std::string between = a.reason.empty() || b.reason.empty() ? "" : ", and ";
  return {*a.error + *b.error, a.reason + between + b.reason};
}

ErrorBudget BudgetMaker::make()
{
  ErrorBudget       budget;
  const SecondModel time = finer_in_time(), modes = parts_.reduction ? finer_in_modes() : unasked();
  const SecondModel sides = parts_.mesh ? curved_in_mesh() : unasked();
  curved_                 = sides.answer;
  const SecondModel mesh  = parts_.mesh ? other_in_mesh(curved_.has_value()) : unasked();
  budget.run_cpu_s        = run_.cpu();
  for (const auto &[model, cpu] : {std::pair(&time, &budget.time_cpu_s), std::pair(&modes, &budget.reduction_cpu_s),
                                   std::pair(&mesh, &budget.mesh_cpu_s)})
    *cpu = model->answer ? model->answer->cpu() : 0.;
  budget.mesh_cpu_s += curved_ ? curved_->cpu() : 0.;
  for (std::size_t i = 0; i < outputs_.size(); ++i)
  {
    BudgetEntry entry;
    entry.output    = outputs_[i].text;
    entry.unit      = run_.units[i];
    entry.value     = run_.values[i];
    entry.bracket   = {entry.value, entry.value};
    entry.time      = outputs_[i].of_signal() ? part_of(i, run_, time, entry) : BudgetPart{no_part, "not integrated"};
    entry.reduction = part_of(i, reference_, modes, entry);
    entry.mesh      = sum(part_of(i, reference_, sides, entry), part_of(i, reference_, mesh, entry));
    if (entry.time.error && entry.reduction.error && entry.mesh.error)
      entry.total = *entry.time.error + *entry.reduction.error + *entry.mesh.error;
    budget.entries.push_back(entry);
  }
  return budget;
}

} // namespace

std::vector<OutputName> budget_outputs(const Scene &scene, const std::string &list)
{
  if (scene.start.periodic)
    throw std::invalid_argument("an error budget compares runs from one start, but start.rule = \"periodic\" finds "
                                "another start for every model; give the state in [start]");
  return outputs_named(list, signal_names(scene), scene.modes.number);
}

ErrorBudget error_budget(const Scene &scene, const std::vector<OutputName> &outputs, const ModelAnswer &run,
                         const std::atomic<bool> *stop)
{
  ModelAnswers models(scene, outputs, stop);
  models.know({}, run);
  return BudgetMaker(models, {}, {}).make();
}

ErrorBudget error_budget(ModelAnswers &models, const ModelVariant &model, const BudgetParts &parts)
{
  return BudgetMaker(models, model, parts).make();
}

} // namespace gestell::apps

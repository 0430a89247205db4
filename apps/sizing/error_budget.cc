#include "apps/sizing/error_budget.h"

#include "apps/scene/build/build_machine.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

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

/// The first event by which `b` differs from `a` up to the time t of a.
Differs differing_event(const ModelAnswer &a, const ModelAnswer &b, double t)
{
  for (std::size_t k = 0; k < a.events.size() && a.events[k].t <= t; ++k)
  {
    if (k >= b.events.size())
      return event_text(a.events[k]) + " at " + short_text(a.events[k].t) + " s is missing";
    if (a.events[k].name != b.events[k].name || a.events[k].kind != b.events[k].kind)
      return event_text(a.events[k]) + " at " + short_text(a.events[k].t) + " s becomes " + event_text(b.events[k]) +
             " at " + short_text(b.events[k].t) + " s";
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
  BudgetMaker(const Scene &scene, const std::vector<OutputName> &outputs, const ModelAnswer &run,
              const std::atomic<bool> *stop)
      : scene_(scene), outputs_(outputs), run_(run), stop_(stop)
  {
  }

  ErrorBudget make();

private:
  ModelAnswer answer(const ModelVariant &variant) const
  {
    ModelAnswer answer = answer_of(scene_, variant, outputs_, stop_);
    if (stop_ && *stop_)
      throw coupling::ConvergenceFailure("interrupted");
    return answer;
  }
  /// Of the scene's frame with another integration; what fails is a reason.
  SecondModel finer_in_time();
  SecondModel finer_in_modes();
  SecondModel other_in_mesh();
  SecondModel raised_in_mesh();
  SecondModel coarser_in_mesh();
  template <typename Make>
  SecondModel tried(const Make &make) const;
  BudgetPart part_of(std::size_t output, const ModelAnswer &first, const SecondModel &second, BudgetEntry &entry) const;

  const Scene                           &scene_;
  const std::vector<OutputName>         &outputs_;
  const ModelAnswer                     &run_;
  const std::atomic<bool>               *stop_;
  std::optional<coupling::MethodOptions> method_;    ///< of the models that differ in mesh and modes
  ModelAnswer                            reference_; ///< the scene's model by that method
};

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
    second.answer = answer({1., -1, method_});
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
  return tried(
      [&]
      {
        const coupling::MethodOptions &given = scene_.run.options.method;
        SecondModel                    second;
        second.answer      = answer({1., -1, finer_method(given)});
        const double power = controlled(given) ? 16. : std::pow(2., std::max(1, given.order));
        second.factor      = power / (power - 1.);
        second.reason      = controlled(given) ? "against a sixteenth of the tolerance" : "against half the step";
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
        const int    m = more_modes(scene_, run_);
        ModelVariant more{1., m, method_};
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
        ModelAnswer  other = answer({coarser, parts ? -1 : modes_asked(scene_, run_), method_});
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

/// Of the mesh itself in elements of degree three, or of a coarser one whose error is reckoned to this one.
SecondModel BudgetMaker::raised_in_mesh()
{
  ModelAnswer first = reference_;
  double      size  = 1.;
  for (int k = 0; k <= coarsest_raised; ++k, size *= coarser)
  {
    if (k > 0 && !mesh_can_change(scene_))
      break;
    if (k > 0)
      first = answer({size, run_.modes, method_});
    if (first.n_frame > most_raised)
      continue;
    ModelVariant variant{size, run_.modes, method_};
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

SecondModel BudgetMaker::other_in_mesh()
{
  if (scene_.frame.source == FrameSource::geometry && !run_.whole && !scene_.reduction.superposition)
    try
    {
      if (SecondModel second = raised_in_mesh(); second.answer)
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

ErrorBudget BudgetMaker::make()
{
  ErrorBudget       budget;
  const SecondModel time = finer_in_time(), modes = finer_in_modes(), mesh = other_in_mesh();
  budget.run_cpu_s = run_.cpu();
  for (const auto &[model, cpu] : {std::pair(&time, &budget.time_cpu_s), std::pair(&modes, &budget.reduction_cpu_s),
                                   std::pair(&mesh, &budget.mesh_cpu_s)})
    *cpu = model->answer ? model->answer->cpu() : 0.;
  for (std::size_t i = 0; i < outputs_.size(); ++i)
  {
    BudgetEntry entry;
    entry.output    = outputs_[i].text;
    entry.unit      = run_.units[i];
    entry.value     = run_.values[i];
    entry.bracket   = {entry.value, entry.value};
    entry.time      = outputs_[i].of_signal() ? part_of(i, run_, time, entry) : BudgetPart{no_part, "not integrated"};
    entry.reduction = part_of(i, reference_, modes, entry);
    entry.mesh      = part_of(i, reference_, mesh, entry);
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
  return BudgetMaker(scene, outputs, run, stop).make();
}

} // namespace gestell::apps

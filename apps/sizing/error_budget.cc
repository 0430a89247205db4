#include "apps/sizing/error_budget.h"

#include "apps/scene/build/build_machine.h"
#include "apps/sizing/size_laws.h"
#include "coupling/frame/frame_cache.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gestell::apps
{

namespace
{

constexpr double mesh_order = 1.5; ///< in the size of the cells: between 1 of edges and 2 and more of smooth fields

using Differs = std::optional<std::string>; ///< the event in which two models differ; none: in none

std::string event_text(const coupling::Event &event)
{
  return event.name + " " + event.kind;
}

/// The first event in which `b` differs from `a` up to the time t of a, for each element separately: if events of two
/// elements change their order, the motion changes only slightly.
Differs differing_event(const ModelAnswer &a, const ModelAnswer &b, double t)
{
  std::map<std::string, std::vector<coupling::Event>> others;
  std::map<std::string, std::size_t>                  visited;
  for (const coupling::Event &event : b.events)
    others[event.name].push_back(event);
  for (const coupling::Event &event : a.events)
  {
    if (event.t > t)
      break;
    const std::vector<coupling::Event> &other = others[event.name];
    const std::size_t                   k     = visited[event.name]++;
    if (k >= other.size())
      return event_text(event) + " at " + short_text(event.t) + " s is missing";
    if (event.kind != other[k].kind)
      return event_text(event) + " at " + short_text(event.t) + " s becomes " + event_text(other[k]) + " at " +
             short_text(other[k].t) + " s";
  }
  return {};
}

/// Difference of two models in an output.  Extremes of stresses and internal forces may agree by chance while
/// vibrations that only one model has are everywhere: theirs is the largest difference of the histories.
double difference_of(const ModelAnswer &a, const ModelAnswer &b, const OutputName &output, std::size_t i)
{
  const double values = std::abs(a.values[i] - b.values[i]);
  const bool   whole  = b.recovered[i] && output.kind.rfind("t_", 0) != 0 && a.histories[i].size() > 0 &&
                     a.histories[i].size() == b.histories[i].size();
  return whole ? std::max(values, (a.histories[i] - b.histories[i]).cwiseAbs().maxCoeff()) : values;
}

/// Two models that differ in one part, or why there are none.
struct Comparison
{
  std::optional<ModelAnswer> first, second;
  double                     factor = 1.;   ///< from the difference of two values to the error of the first
  std::vector<double>        factors{};     ///< the same by output, in place of `factor`; empty: not so
  std::string                reason;        ///< the second model; if there is none, the reason
  bool                       exact = false; ///< there is nothing to err
};

Comparison nothing_errs(const std::string &reason)
{
  Comparison none;
  none.exact  = true;
  none.reason = reason;
  return none;
}

Comparison not_known(const std::string &reason)
{
  Comparison none;
  none.reason = reason;
  return none;
}

/// Each comparison begins with the finer model of the one before: all differences together are that to the finest.
class BudgetMaker
{
public:
  BudgetMaker(ModelAnswers &models, const ModelVariant &model)
      : models_(models), scene_(varied(models.scene(), model)), outputs_(models.outputs()), run_(models.of(model)),
        finest_(model), stop_(models.stop())
  {
  }

  JudgedModel make();

private:
  /// @param cpu  [s] that it took
  template <typename Make>
  Comparison                timed(double &cpu, const Make &make);
  Comparison                against(ModelVariant finer, std::string reason);
  Comparison                sides();
  Comparison                degree();
  Comparison                raised();
  Comparison                coarser_cells();
  Comparison                more_modes_kept();
  std::optional<Comparison> exact_in_time();
  Comparison                finer_steps();
  std::string               what_is_finest();
  BudgetPart                part_of(std::size_t output, const Comparison &comparison, BudgetEntry &entry) const;

  ModelAnswers                  &models_;
  const Scene                    scene_; ///< of the model
  const std::vector<OutputName> &outputs_;
  const ModelAnswer              run_;
  ModelVariant                   finest_; ///< of the models so far
  const std::atomic<bool>       *stop_;
};

/// Converts a failure to a reason.
template <typename Make>
Comparison BudgetMaker::timed(double &cpu, const Make &make)
{
  const double begin = coupling::cpu_time_without_cache();
  Comparison   comparison;
  try
  {
    comparison = make();
  }
  catch (const std::exception &failure)
  {
    if (stop_ && *stop_)
      throw;
    comparison = not_known(std::string("the second model failed: ") + failure.what());
  }
  cpu += coupling::cpu_time_without_cache() - begin;
  return comparison;
}

/// The finest model so far against one that is finer, which takes its place.
Comparison BudgetMaker::against(ModelVariant finer, std::string reason)
{
  Comparison comparison;
  comparison.first  = models_.of(finest_);
  comparison.second = models_.of(finer);
  comparison.reason = "against " + std::move(reason);
  finest_           = std::move(finer);
  return comparison;
}

/// Geometry error of straight sides at curved faces: compared with the same mesh with sides that follow the faces.  It
/// does not decrease with finer meshes while circles have the minimum number of sides, which two sizes do not reveal.
Comparison BudgetMaker::sides()
{
  if (scene_.frame.source != FrameSource::geometry && scene_.frame.source != FrameSource::parts)
    return nothing_errs("");
  switch (sides_of(scene_, models_.planes()))
  {
  case Sides::exact:
    return nothing_errs("");
  case Sides::unknown:
    return not_known("its elements have straight edges at curved faces, as in every second mesh; tetrahedra with "
                     "mesh.curved = true follow the faces");
  case Sides::straight:
    break;
  }
  ModelVariant curved = finest_;
  curved.cells        = Cells::curved;
  if (scene_.frame.source == FrameSource::geometry && modes_are_chosen(scene_))
    curved.modes = run_.modes;
  return against(curved, "curved element edges");
}

Comparison BudgetMaker::degree()
{
  if (scene_.frame.source == FrameSource::none || scene_.frame.source == FrameSource::matrices)
    return nothing_errs(scene_.frame.source == FrameSource::none ? "there is no frame" : "the matrices are the frame");
  const ModelVariant before = finest_;
  if (scene_.frame.source == FrameSource::geometry && !run_.whole && !scene_.reduction.superposition)
    try
    {
      if (Comparison third = raised(); third.second)
        return third;
    }
    catch (const std::exception &) // such as an output that elements of degree three do not give
    {
      if (stop_ && *stop_)
        throw;
      finest_ = before;
    }
  return coarser_cells();
}

/// Mesh error from elements of degree three, or from a coarser mesh and extrapolated to this one; a mesh that cannot be
/// made is left out.
Comparison BudgetMaker::raised()
{
  ModelVariant level            = finest_;
  level.modes                   = run_.modes;
  constexpr int coarsest_raised = 3; // powers of the ratio of sizes: 1.5^3 = 3.4 times as coarse
  std::string   skipped;
  for (int k = 0; k <= coarsest_raised && (k == 0 || mesh_can_change(scene_)); ++k, level.mesh *= ratio_of_meshes)
    try
    {
      const std::string size  = short_text(std::pow(ratio_of_meshes, k), 3) + " times the size";
      const ModelAnswer first = k > 0 ? models_.of(level) : models_.of(finest_);
      // coordinates of a mesh that is compared with degree three, which has three times as many
      constexpr int most_raised = 60000;
      if (first.n_frame > most_raised)
        continue;
      const double ratio = std::cbrt(double(run_.n_frame) / first.n_frame);
      if (k > 0)
        finest_ = level;
      ModelVariant variant = level;
      variant.raised       = true;
      if (modes_are_chosen(scene_)) // a frame may already be available
        variant.made = std::max(more_modes(scene_, run_), more_than(finest_.made));
      Comparison comparison =
          against(variant, "elements of degree three" + (k > 0 ? " in elements of " + size : "") + skipped);
      constexpr double left_over = 1.25; // of what degree three corrects, docs/theory/mesh_error.md (4b)
      comparison.factor          = left_over / std::pow(ratio, mesh_order);
      return comparison;
    }
    catch (const FrameFailure &failure)
    {
      if (k == 0 || (stop_ && *stop_))
        throw;
      skipped += "; elements of " + short_text(std::pow(ratio_of_meshes, k), 3) +
                 " times the size are omitted: " + failure.what();
    }
  return {};
}

/// Beside the finest model so far, which stays that; the next size where a mesh cannot be made.
Comparison BudgetMaker::coarser_cells()
{
  if (!mesh_can_change(scene_))
    return not_known("the mesh comes from a file and cannot be made coarser");
  ModelVariant variant = finest_;
  if (scene_.frame.source != FrameSource::parts) // the second reduction of parts stays unchanged
    variant.modes = modes_asked(scene_, run_);
  Comparison comparison;
  comparison.first       = models_.of(finest_);
  constexpr int coarsest = 2; // powers of the ratio of sizes
  std::string   skipped, size;
  for (int k = 1; k <= coarsest && !comparison.second; ++k)
    try
    {
      variant.mesh *= ratio_of_meshes;
      size              = "elements of " + short_text(std::pow(ratio_of_meshes, k), 3) + " times the size";
      comparison.second = models_.of(variant);
    }
    catch (const FrameFailure &failure)
    {
      if (k == coarsest || (stop_ && *stop_))
        throw;
      skipped = "; " + size + " are left out: " + failure.what();
    }
  const double     ratio  = std::cbrt(double(run_.n_frame) / comparison.second->n_frame);
  constexpr double hardly = 1.1; // ratio of sizes below which two meshes are alike
  if (ratio < hardly)
    return not_known(size + " give nearly the same mesh, because small features determine it");
  comparison.factor = 1. / (std::pow(ratio, mesh_order) - 1.);
  comparison.reason = "against " + size + skipped;
  return comparison;
}

Comparison BudgetMaker::more_modes_kept()
{
  if (frame_path(scene_) == FramePath::from_file)
    return not_known("the frame was reduced outside Gestell, so its reduction error is unknown");
  if (!modes_are_chosen(scene_) && scene_.reduction.method != "guyan")
    return nothing_errs("the frame is not reduced");
  if (run_.modes >= run_.most_modes)
    return nothing_errs("all modes are retained");
  ModelVariant more = finest_; // its frame already has these modes if it was made with more
  more.modes        = more_modes(scene_, run_);
  if (!modes_are_chosen(scene_)) // only statics
    more.reduction = "craig-bampton";
  Comparison         comparison = against(more, std::to_string(more.modes) + " modes");
  const ModelAnswer &finer      = *comparison.second;
  for (const bool recovered : finer.recovered)
    comparison.factors.push_back(
        finer.modes >= finer.most_modes
            ? 1.
            : truncation_factor(finer.omega, comparison.first->modes, truncation_power(recovered, finer.superposed)));
  return comparison;
}

/// Integrates with `exact`, so that later models differ in nothing else; none if it cannot treat the machine.
std::optional<Comparison> BudgetMaker::exact_in_time()
{
  try
  {
    ModelVariant finer = finest_;
    finer.method       = finest_method(scene_);
    Comparison exact   = against(finer, "");
    exact.reason += exact.second->method;
    return exact;
  }
  catch (const std::exception &)
  {
    if (stop_ && *stop_)
      throw;
    return {};
  }
}

Comparison BudgetMaker::finer_steps()
{
  const coupling::MethodOptions &given = scene_.run.options.method;
  ModelVariant                   finer = finest_;
  finer.method                         = finer_method(given);
  const double power                   = controlled(given) ? 16. : std::pow(2., std::max(1, given.order));
  Comparison   steps = against(finer, controlled(given) ? "a sixteenth of the tolerance" : "half the step");
  steps.factor       = power / (power - 1.);
  return steps;
}

BudgetPart BudgetMaker::part_of(std::size_t output, const Comparison &comparison, BudgetEntry &entry) const
{
  if (comparison.exact)
    return {0., comparison.reason};
  if (!comparison.second)
    return {std::nullopt, comparison.reason};
  const double v = comparison.first->values[output], w = comparison.second->values[output];
  for (const double value : {v, w})
    entry.bracket = {std::min(entry.bracket->first, value), std::max(entry.bracket->second, value)};
  if (outputs_[output].of_signal())
    if (const Differs event =
            differing_event(*comparison.first, *comparison.second, comparison.first->decided_s[output]))
      return {std::nullopt, "the order of events changes, " + comparison.reason + ": " + *event};
  const double factor = comparison.factors.empty() ? comparison.factor : comparison.factors[output];
  if (!std::isfinite(factor))
    return {std::nullopt, "the first truncated mode has the frequency of the last one, " + comparison.reason};
  return {factor * (comparison.factors.empty()
                        ? std::abs(v - w)
                        : difference_of(*comparison.first, *comparison.second, outputs_[output], output)),
          comparison.reason};
}

/// Sum of two causes; unknown if one of them is.
BudgetPart sum(const BudgetPart &a, const BudgetPart &b)
{
  if (!a.error || !b.error)
    return a.error ? b : a;
  const std::string between = a.reason.empty() || b.reason.empty() ? "" : ", and ";
  return {*a.error + *b.error, a.reason + between + b.reason};
}

std::string BudgetMaker::what_is_finest()
{
  const ModelAnswer &finest = models_.of(finest_);
  return (finest.n_frame > 0 ? std::to_string(finest.n_frame) + " DOFs" : std::string()) +
         (finest_.raised ? " in elements of degree three" : "") + (finest.n_frame > 0 ? ", " : "") +
         (finest.modes >= 0 ? std::to_string(finest.modes) + " modes, " : "") + finest.method;
}

JudgedModel BudgetMaker::make()
{
  JudgedModel               judged;
  ErrorBudget              &budget = judged.budget;
  std::optional<Comparison> time;
  timed(budget.time_cpu_s, [&] { return (time = exact_in_time()) ? *time : Comparison(); });
  const Comparison edges = timed(budget.mesh_cpu_s, [&] { return sides(); });
  const Comparison mesh  = timed(budget.mesh_cpu_s, [&] { return degree(); });
  const Comparison modes = timed(budget.reduction_cpu_s, [&] { return more_modes_kept(); });
  if (!time)
    time = timed(budget.time_cpu_s, [&] { return finer_steps(); });
  budget.run_cpu_s = run_.cpu();
  for (std::size_t i = 0; i < outputs_.size(); ++i)
  {
    BudgetEntry entry;
    entry.output              = outputs_[i].text;
    entry.unit                = run_.units[i];
    entry.value               = run_.values[i];
    entry.bracket             = {entry.value, entry.value};
    entry.time                = outputs_[i].of_signal() ? part_of(i, *time, entry) : BudgetPart{0., "not integrated"};
    entry.reduction           = part_of(i, modes, entry);
    const BudgetPart straight = part_of(i, edges, entry);
    entry.mesh                = sum(straight, part_of(i, mesh, entry));
    entry.sides               = straight.error;
    if (entry.time.error && entry.reduction.error && entry.mesh.error)
      entry.total = *entry.time.error + *entry.reduction.error + *entry.mesh.error;
    budget.entries.push_back(entry);
  }
  judged.run    = run_;
  judged.finest = models_.of(finest_);
  judged.what   = what_is_finest();
  return judged;
}

} // namespace

std::vector<OutputName> budget_outputs(const Scene &scene, const std::string &list)
{
  if (scene.start.periodic)
    throw std::invalid_argument("an error budget compares runs from the same initial state, but start.rule = "
                                "\"periodic\" finds another one for every model; give the state in [start]");
  return outputs_named(list, signal_names(scene), scene.modes.number);
}

ErrorBudget error_budget(const Scene &scene, const std::vector<OutputName> &outputs, const ModelAnswer &run,
                         const std::atomic<bool> *stop)
{
  ModelAnswers models(scene, outputs, stop);
  models.know({}, run);
  return judged(models, {}).budget;
}

JudgedModel judged(ModelAnswers &models, const ModelVariant &model)
{
  return BudgetMaker(models, model).make();
}

} // namespace gestell::apps

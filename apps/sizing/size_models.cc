#include "apps/sizing/size_models.h"

#include "coupling/frame/frame_cache.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>

namespace gestell::apps
{

double memory_taken()
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kilobytes = 0.; word == "VmHWM:" && status >> kilobytes)
      return 1024. * kilobytes;
  return 0.;
}

SizeModels::SizeModels(const Scene &scene, const std::vector<OutputName> &outputs, double tolerance,
                       const std::atomic<bool> *stop)
    : scene_(scene), outputs_(outputs), tolerance_(tolerance), stop_(stop), models_(scene, outputs, stop)
{
  constexpr double smallest_tolerance = 1e-8; // of outputs: chosen; runs of the search have 1e-10
  if (!(tolerance >= smallest_tolerance) || tolerance > 1.)
    throw std::invalid_argument(
        "--tolerance: needs a relative error between 1e-8, below which rounding decides, and 1, "
        "got " +
        short_text(tolerance));
}

/// Whether `exact` can treat the machine, with the other keys of the scene.
bool SizeModels::takes_exact(const SizePlace &place)
{
  const coupling::MethodOptions &given = scene_.run.options.method;
  if (given.method != "exact" && !given.own.empty())
    return false;
  try
  {
    ModelVariant variant      = variant_of(place);
    variant.method            = finest_method(scene_);
    Scene short_run           = varied(scene_, variant);
    auto &options             = short_run.run.options;
    options.end               = options.begin + 1e-3 * (options.end - options.begin);
    options.from              = options.begin; // the test needs no extremes
    short_run.run.last_period = false;
    answer_of(short_run, {}, outputs_, stop_);
    return true;
  }
  catch (const FrameFailure &)
  {
    throw;
  }
  catch (const std::exception &)
  {
    if (stop_ && *stop_)
      throw;
    return false;
  }
}

/// Modes that a frame given by matrices can keep at most.
int SizeModels::most_modes() const
{
  if (scene_.frame.source != FrameSource::matrices)
    return mode_ladder().back();
  const int interface = int(scene_.frame.matrices.interface_coordinates().size());
  return std::max(1, int(scene_.frame.matrices.M.rows()) - (scene_.reduction.superposition ? 0 : interface));
}

ModelVariant SizeModels::variant_of(const SizePlace &place, double most_cells) const
{
  ModelVariant variant;
  variant.mesh       = place.mesh;
  variant.modes      = place.modes < 0 ? -1 : std::min(place.modes, most_modes());
  variant.cells      = place.cells;
  variant.most_cells = most_cells;
  variant.method     = by_exact_ ? finest_method(scene_) : scene_.run.options.method;
  (by_exact_ || controlled(*variant.method) ? variant.method->tolerance : variant.method->step) = place.time;
  return variant;
}

bool SizeModels::skip(const SizePlace &place, const std::exception &failure)
{
  constexpr std::size_t most = 4; // models: that many do not fail for their size
  skipped_.push_back("elements of " + short_text(place.mesh, 3) + " times the size: " + failure.what());
  return skipped_.size() < most && dynamic_cast<const FrameFailure *>(&failure);
}

SizePlace SizeModels::coarse()
{
  SizePlace place;
  place.mesh = mesh_can_change(scene_) ? coarsest_mesh : 1.;
  for (constexpr double rounding = 1e-9;; place.mesh /= ratio_of_meshes)
    try
    {
      return coarse_on(place);
    }
    catch (const FrameFailure &failure)
    {
      if (place.mesh <= 1. + rounding || (stop_ && *stop_))
        throw;
      skip(place, failure);
    }
}

SizePlace SizeModels::coarse_on(SizePlace place)
{
  constexpr int first_modes = 8; // the search adds and removes others
  place.modes               = modes_are_chosen(scene_) ? std::min(first_modes, most_modes()) : -1;
  constexpr double loosest  = 1e-3; // tolerance of `exact`: beyond it the largest step rules
  place.time                = loosest;
  if (by_exact_ = takes_exact(place); by_exact_)
    return first_ = place;
  if (!scene_.run.step_given)
    throw std::invalid_argument(scene_.run.place + ": the step follows from the modes, but `size` needs a step that it "
                                                   "can vary: set run.step, or a method with a tolerance");
  const coupling::MethodOptions &given   = scene_.run.options.method;
  constexpr double               longest = 8.; // of the scene's steps: eight times, four, two, as given
  for (double factor = longest; factor >= 1.; factor /= 2.)
    try
    {
      place.time = controlled(given) ? factor * factor * given.tolerance : factor * given.step;
      models_.of(variant_of(place));
      break;
    }
    catch (const coupling::ConvergenceFailure &)
    {
      if (factor == 1. || (stop_ && *stop_))
        throw;
    }
  return first_ = place;
}

double SizeModels::scale_of(std::size_t output, const ModelAnswer &answer) const
{
  if (answer.units[output] == "s" && outputs_[output].kind.rfind("t_", 0) == 0)
    return scene_.run.options.end - scene_.run.options.begin;
  return std::max(std::abs(answer.values[output]), answer.sizes[output]);
}

Shares SizeModels::shares_of(const BudgetEntry &entry, double allowed) const
{
  constexpr double unknown = std::numeric_limits<double>::infinity();
  const auto       share   = [&](const std::optional<double> &error) {
    return !error ? unknown : *error == 0. ? 0. : *error / allowed;
  };
  std::optional<double> degree;
  if (entry.mesh.error)
    degree = std::max(0., *entry.mesh.error - *entry.sides);
  return {share(entry.sides), share(degree), share(entry.reduction.error), share(entry.time.error)};
}

/// Description and cost of a model.
SizeRung SizeModels::rung_of(const SizePlace &place, const ModelAnswer &answer) const
{
  const Scene             scene  = varied(scene_, variant_of(place));
  const auto             &method = scene.run.options.method;
  const fem::MeshOptions *mesh   = mesh_is_made(scene)               ? &scene.frame.geometry.mesh
                                   : meshes_of_parts_are_made(scene) ? &scene.frame.parts.parts.front().geometry.mesh
                                                                     : nullptr;
  SizeRung                rung;
  if (mesh)
  {
    rung.mesh_size = mesh->size;
    rung.cells     = mesh->plates == fem::Plates::swept ? "swept" : mesh->curved ? "curved" : "straight";
  }
  rung.coordinates = answer.n_frame;
  rung.interface   = answer.interface;
  rung.modes       = modes_are_chosen(scene) ? modes_asked(scene, answer) : -1;
  rung.reduction   = modes_are_chosen(scene) ? scene.reduction.method : "";
  rung.method      = method.method;
  rung.step        = method.step;
  rung.tolerance   = method.tolerance;
  rung.cpu_s       = answer.cpu();
  return rung;
}

SizedPlace SizeModels::judge(const SizePlace &place, double most_cells)
{
  const double begin = coupling::cpu_time_without_cache();
  SizedPlace   here;
  ModelVariant variant = variant_of(place, most_cells);
  if (has_frames(place))
    variant.made = first_.modes;
  judged_first_          = true;
  here.place             = place;
  here.model             = judged(models_, variant);
  const ModelAnswer &run = here.model.run;
  here.point             = {place.mesh, double(run.n_frame), run.prepare_cpu, {}};
  here.work              = std::max(1., (coupling::cpu_time_without_cache() - begin) / run.cpu());
  here.rung              = rung_of(place, run);
  here.rung.entries      = here.model.budget.entries;
  take_shares(here);
  return here;
}

void SizeModels::settle(SizedPlace &judged)
{
  const ModelAnswer &run = judged.model.run = models_.of(variant_of(judged.place));
  judged.rung.cpu_s                         = run.cpu();
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    judged.rung.entries[i].value = run.values[i];
}

void SizeModels::take_shares(SizedPlace &judged) const
{
  SizeRung &rung = judged.rung;
  judged.point.shares.clear();
  rung.share = 0.;
  for (std::size_t i = 0; i < outputs_.size(); ++i)
  {
    const Shares shares = shares_of(rung.entries[i], tolerance_ * scale_of(i, judged.model.run));
    judged.point.shares.push_back(shares);
    if (shares.total() <= rung.share)
      continue;
    const double mesh = shares.mesh(), modes = shares.modes, time = shares.time;
    rung.share = shares.total();
    rung.worst = (mesh >= modes && mesh >= time ? "mesh of "
                  : modes >= time               ? "reduction of "
                                                : "time of ") +
                 outputs_[i].text;
  }
}

void SizeModels::compare(SizedPlace &judged, const ModelAnswer &finer) const
{
  for (std::size_t i = 0; i < outputs_.size(); ++i)
  {
    BudgetEntry &entry      = judged.rung.entries[i];
    const double difference = std::abs(finer.values[i] - entry.value);
    entry.bracket = {std::min(entry.bracket->first, finer.values[i]), std::max(entry.bracket->second, finer.values[i])};
    if (!entry.mesh.error || difference <= *entry.mesh.error)
      continue;
    if (entry.total)
      *entry.total += difference - *entry.mesh.error;
    entry.mesh = {difference, "against finer elements"};
  }
  judged.confirmed = true;
  take_shares(judged);
}

bool SizeModels::by_steps() const
{
  return !by_exact_ && !controlled(scene_.run.options.method);
}

SizeModels::TimeLaw SizeModels::time_law() const
{
  constexpr double finest_tolerance = 1e-9; // ten times that of the finest model of a budget
  if (by_exact_)
    return {10., 1., finest_tolerance};
  return by_steps() ? TimeLaw{2., double(std::max(1, scene_.run.options.method.order)), 0.} : TimeLaw{4., 1., 0.};
}

std::vector<SizePlace> SizeModels::about(const SizePlace &chosen, const SizePlace &coarsest) const
{
  std::vector<double> meshes   = {chosen.mesh}, times;
  constexpr double    rounding = 1e-9; // of factors that were multiplied a few times
  if (mesh_can_change(scene_))
    for (double mesh = chosen.mesh / ratio_of_meshes; mesh <= coarsest.mesh; mesh *= ratio_of_meshes)
      if (std::abs(mesh / chosen.mesh - 1.) > rounding)
        meshes.push_back(mesh);
  const double factor = time_law().factor;
  for (double time = coarsest.time; time * factor >= chosen.time * (1. - rounding); time /= factor)
    times.push_back(std::abs(time / chosen.time - 1.) < rounding ? chosen.time : time);
  std::vector<int> modes = {chosen.modes};
  if (chosen.modes >= 0)
  {
    const auto &ladder = mode_ladder();
    const auto  above  = std::upper_bound(ladder.begin(), ladder.end(), chosen.modes);
    modes.assign(ladder.begin(), above == ladder.end() ? above : above + 1);
    if (modes.back() != chosen.modes && std::find(modes.begin(), modes.end(), chosen.modes) == modes.end())
      modes.push_back(chosen.modes); // all that a frame given by matrices has
  }
  std::vector<SizePlace> places;
  for (const double mesh : meshes)
    for (const int m : modes)
      for (const double time : times)
        if (m <= most_modes())
          places.push_back({chosen.cells, mesh, m, time});
  return places;
}

SizedPlace *best_of(std::deque<SizedPlace> &judged)
{
  SizedPlace *best    = nullptr;
  const auto  smaller = [](const SizedPlace &a, const SizedPlace &b)
  {
    return std::make_tuple(a.point.coordinates, a.place.modes, a.model.run.cpu()) <
           std::make_tuple(b.point.coordinates, b.place.modes, b.model.run.cpu());
  };
  for (SizedPlace &each : judged)
    if (each.rung.share <= 1. && (!best || smaller(each, *best)))
      best = &each;
  return best;
}

} // namespace gestell::apps

#include "apps/sizing/size_search.h"

#include "apps/sizing/omissions.h"
#include "coupling/integration/system/convergence_failure.h"
#include "coupling/reduction/reductions.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <tuple>

namespace gestell::apps
{

namespace
{

constexpr double ratio_of_meshes = 1.5;
constexpr int    coarsest_mesh = -2, finest_mesh = 4; ///< powers of the ratio below the scene's size
constexpr int    mode_numbers[] = {0, 2, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256};
constexpr int    n_mode_numbers = int(std::size(mode_numbers));
constexpr int    first_modes = 2, first_time = 1, n_tolerances = 7, n_steps = 10;
constexpr double smallest_tolerance = 1e-8;
constexpr int    most_rungs         = 40;
constexpr int    thin_after         = 2;   ///< rungs
constexpr double worth_it           = 0.9; ///< of the CPU time, below which another reduction is taken
constexpr double far_too_stiff      = 4.;  ///< times what is allowed: on walls, at order one, 64 times the coordinates

constexpr auto thin_walls = "walls are thin";

constexpr double unknown = std::numeric_limits<double>::infinity();

/// Numbers of the rungs of the three ladders.
struct Place
{
  int         mesh = 0, modes = 0, time = 0;
  std::string reduction{}; ///< empty: the scene's
  bool        operator<(const Place &other) const
  {
    return std::tie(mesh, modes, time, reduction) < std::tie(other.mesh, other.modes, other.time, other.reduction);
  }
};

/// Shares of the parts in the tolerance, of the output with the largest.
struct Shares
{
  double      mesh = 0., modes = 0., time = 0., total = 0.;
  std::size_t output = 0;

  std::string worst() const { return mesh >= modes && mesh >= time ? "mesh" : modes >= time ? "reduction" : "time"; }
};

/// [byte] that the program has taken at most so far; 0: the system does not say.
double memory_taken()
{
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kilobytes = 0.; word == "VmHWM:" && status >> kilobytes)
      return 1024. * kilobytes;
  return 0.;
}

class Climb
{
public:
  /// @param until_thin  ends where cells are far too stiff for the walls
  Climb(const Scene &scene, const std::vector<OutputName> &outputs, const SizeOptions &options, bool until_thin)
      : scene_(scene), outputs_(outputs), options_(options), by_exact_(takes_exact()), until_thin_(until_thin)
  {
    if (!(options.tolerance >= smallest_tolerance) || options.tolerance > 1.)
      throw std::invalid_argument("--tolerance: needs a relative error between 1e-8, below which rounding decides, and "
                                  "1, got " +
                                  short_text(options.tolerance));
    if (!by_exact_ && !scene.run.step_given)
      throw std::invalid_argument(scene.run.place + ": the step follows from the modes, and `size` varies a given one: "
                                                    "give run.step, or a method with a tolerance");
  }

  SizedModel run();

private:
  bool          takes_exact() const;
  int           most_given() const;
  ModelVariant  variant_of(const Place &place) const;
  int           last_time() const { return by_exact_ ? n_tolerances - 1 : n_steps - 1; }
  const Shares &look(const Place &place);
  Shares        shares_of(const ModelAnswer &answer, const SizeRung &rung) const;
  bool          fits(const Place &place) { return look(place).total <= 1.; }
  bool          finer(Place &place);
  void          coarsen(Place &place);
  void          try_reductions(Place &place);
  void          prove(const Place &place, SizedModel &model);
  void          question(const Place &place, SizeResult &result);
  void          try_all(const Place &place, SizeResult &result);
  SizeRung      rung_of(const Scene &scene, const ModelAnswer &answer) const;
  double        scale_of(std::size_t output, const ModelAnswer &answer) const;

  const Scene                   &scene_;
  const std::vector<OutputName> &outputs_;
  const SizeOptions             &options_;
  bool                           by_exact_, until_thin_;
  std::map<Place, Shares>        known_;
  std::map<Place, std::size_t>   rung_of_;
  std::map<Place, ModelAnswer>   answers_;
  SizeResult                     result_;
  ModelAnswer                    finer_; ///< of the proof
  int                            most_modes_ = n_mode_numbers - 1;
};

/// Whether `exact` treats the machine, with the scene's keys beside it.
bool Climb::takes_exact() const
{
  const coupling::MethodOptions &given = scene_.run.options.method;
  if (given.method != "exact" && !given.own.empty())
    return false;
  try
  {
    const double coarse    = mesh_can_change(scene_) ? std::pow(ratio_of_meshes, -coarsest_mesh) : 1.;
    Scene        short_run = varied(scene_, {coarse, -1, finest_method(scene_)});
    short_run.run.options.end =
        short_run.run.options.begin + 1e-3 * (short_run.run.options.end - short_run.run.options.begin);
    short_run.run.options.from = short_run.run.options.begin; // whether it runs is asked, no extreme
    short_run.run.last_period  = false;
    answer_of(short_run, {}, outputs_, options_.stop);
    return true;
  }
  catch (const std::exception &)
  {
    return false;
  }
}

/// Modes that a frame given by matrices can keep at most.
int Climb::most_given() const
{
  if (scene_.frame.source != FrameSource::matrices)
    return mode_numbers[n_mode_numbers - 1];
  const int interface = int(scene_.frame.matrices.interface_coordinates().size());
  return std::max(1, int(scene_.frame.matrices.M.rows()) - (scene_.reduction.superposition ? 0 : interface));
}

ModelVariant Climb::variant_of(const Place &place) const
{
  ModelVariant variant;
  variant.reduction = place.reduction;
  if (mesh_can_change(scene_))
    variant.mesh = std::pow(ratio_of_meshes, -(place.mesh + coarsest_mesh));
  if (modes_are_chosen(scene_))
    variant.modes = std::min(mode_numbers[place.modes], most_given());
  if (by_exact_)
  {
    variant.method            = finest_method(scene_);
    variant.method->tolerance = std::pow(10., -3 - place.time);
  }
  else
  {
    coupling::MethodOptions method = scene_.run.options.method;
    const double            factor = std::pow(2., 3 - place.time);
    if (controlled(method))
      method.tolerance *= factor * factor;
    else
      method.step *= factor;
    variant.method = method;
  }
  return variant;
}

double Climb::scale_of(std::size_t output, const ModelAnswer &answer) const
{
  if (answer.units[output] == "s" && outputs_[output].kind.rfind("t_", 0) == 0)
    return scene_.run.options.end - scene_.run.options.begin;
  return std::max(std::abs(answer.values[output]), answer.sizes[output]);
}

Shares Climb::shares_of(const ModelAnswer &answer, const SizeRung &rung) const
{
  Shares     shares;
  const auto share = [&](const BudgetPart &part, double allowed) {
    return !part.error ? unknown : *part.error == 0. ? 0. : *part.error / allowed;
  };
  for (std::size_t i = 0; i < outputs_.size(); ++i)
  {
    const double allowed = options_.tolerance * scale_of(i, answer);
    const Shares here{share(rung.entries[i].mesh, allowed), share(rung.entries[i].reduction, allowed),
                      share(rung.entries[i].time, allowed), 0., i};
    if (const double total = here.mesh + here.modes + here.time; total >= shares.total)
      shares = {here.mesh, here.modes, here.time, total, i};
  }
  return shares;
}

/// What the model is and costs.
SizeRung Climb::rung_of(const Scene &scene, const ModelAnswer &answer) const
{
  const auto &method = scene.run.options.method;
  SizeRung    rung;
  rung.mesh_size   = mesh_is_made(scene)               ? scene.frame.geometry.mesh.size
                     : meshes_of_parts_are_made(scene) ? scene.frame.parts.parts.front().geometry.mesh.size
                                                       : 0.;
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

const Shares &Climb::look(const Place &place)
{
  if (const auto known = known_.find(place); known != known_.end())
    return known->second;
  const Scene       scene  = varied(scene_, variant_of(place));
  const ModelAnswer answer = answer_of(scene, {}, outputs_, options_.stop);
  const ErrorBudget budget = error_budget(scene, outputs_, answer, options_.stop);
  SizeRung          rung   = rung_of(scene, answer);
  rung.entries             = budget.entries;
  const Shares shares      = shares_of(answer, rung);
  while (most_modes_ > 0 && answer.n_frame > 0 && mode_numbers[most_modes_] > answer.most_modes)
    --most_modes_;
  rung.share = shares.total;
  if (shares.total > 0.)
    rung.worst = shares.worst() + " of " + outputs_[shares.output].text;
  rung_of_[place] = result_.ladder.size();
  answers_[place] = answer;
  result_.ladder.push_back(rung);
  if (options_.on_rung)
    options_.on_rung(result_.ladder.back());
  return known_[place] = shares;
}

/// One rung finer in what errs most and can be refined; false: nothing can.
bool Climb::finer(Place &place)
{
  const Shares shares = look(place);
  struct Part
  {
    double share;
    int Place::*rung;
    int         last;
  };
  std::vector<Part> parts = {{shares.mesh, &Place::mesh, mesh_can_change(scene_) ? finest_mesh - coarsest_mesh : 0},
                             {shares.modes, &Place::modes, modes_are_chosen(scene_) ? most_modes_ : 0},
                             {shares.time, &Place::time, last_time()}};
  std::stable_sort(parts.begin(), parts.end(), [](const Part &a, const Part &b) { return a.share > b.share; });
  for (const Part &part : parts)
    if (part.share > 0. && place.*part.rung < part.last)
    {
      ++(place.*part.rung);
      return true;
    }
  return false;
}

/// As coarse in each part as the tolerance allows, what costs most first.
void Climb::coarsen(Place &place)
{
  for (int Place::*rung : {&Place::mesh, &Place::modes, &Place::time})
    while (place.*rung > 0 && int(result_.ladder.size()) < most_rungs)
    {
      Place coarser = place;
      --(coarser.*rung);
      if (!fits(coarser))
        break;
      place = coarser;
    }
}

/// Another reduction with as many modes, where it takes less and fits.  One that does not apply is left.
void Climb::try_reductions(Place &place)
{
  if (!modes_are_chosen(scene_) || scene_.frame.source == FrameSource::parts || !options_.readable)
    return;
  for (const coupling::ReductionEntry &entry : coupling::Reductions::entries())
  {
    Place other        = place;
    other.reduction    = entry.name;
    const bool reduces = entry.makes != coupling::ReductionEntry::Makes::no_frame && entry.takes("modes");
    if (!reduces || entry.name == scene_.reduction.method || !options_.readable(variant_of(other)))
      continue;
    try
    {
      const Scene  scene = varied(scene_, variant_of(other));
      const double cpu   = rung_of(scene, answer_of(scene, {}, outputs_, options_.stop)).cpu_s;
      if (cpu < worth_it * result_.ladder[rung_of_[place]].cpu_s && fits(other))
        place = other;
    }
    catch (const std::exception &)
    {
      if (options_.stop && *options_.stop)
        throw;
    }
  }
}

void Climb::prove(const Place &place, SizedModel &model)
{
  const ModelVariant chosen = variant_of(place);
  ModelVariant       finer  = chosen;
  finer.mesh /= ratio_of_meshes;
  if (chosen.modes >= 0)
    finer.modes = more_modes(varied(scene_, chosen), answers_[place]);
  finer.method = by_exact_ ? finest_method(scene_) : finer_method(*chosen.method);
  try
  {
    const ModelAnswer better = answer_of(scene_, finer, outputs_, options_.stop);
    finer_                   = better;
    for (std::size_t i = 0; i < outputs_.size(); ++i)
      model.result.proof.push_back({outputs_[i].text, better.units[i], answers_[place].values[i], better.values[i]});
    model.result.finer = (better.n_frame > 0 ? std::to_string(better.n_frame) + " coordinates, " : "") +
                         (better.modes >= 0 ? std::to_string(better.modes) + " modes, " : "") + better.method;
  }
  catch (const std::exception &failure)
  {
    if (options_.stop && *options_.stop)
      throw;
    model.result.finer = std::string("the finer model failed: ") + failure.what();
  }
}

void Climb::question(const Place &place, SizeResult &result)
{
  const Scene         chosen = varied(scene_, variant_of(place));
  std::vector<double> scales;
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    scales.push_back(scale_of(i, answers_[place]));
  const Omissions found =
      find_omissions({chosen, answers_[place], outputs_, scales, options_.tolerance}, options_.stop);
  result.left_out = found.left_out;
  result.missing  = found.missing;
}

/// Every model up to one rung finer than the chosen one in each part, against the finer one of the proof.
void Climb::try_all(const Place &place, SizeResult &result)
{
  if (finer_.values.empty())
    return;
  const int last_mesh  = mesh_can_change(scene_) ? std::min(place.mesh + 1, finest_mesh - coarsest_mesh) : 0;
  const int last_modes = modes_are_chosen(scene_) ? std::min(place.modes + 1, most_modes_) : 0;
  const int last       = std::min(place.time + 1, last_time());
  std::vector<std::string> reductions = {""};
  if (!place.reduction.empty())
    reductions.push_back(place.reduction);
  for (const std::string &reduction : reductions)
    for (int mesh = 0; mesh <= last_mesh; ++mesh)
      for (int modes = 0; modes <= last_modes; ++modes)
        for (int time = 0; time <= last; ++time)
        {
          const Place       here{mesh, modes, time, reduction};
          const Scene       scene  = varied(scene_, variant_of(here));
          const ModelAnswer answer = answer_of(scene, {}, outputs_, options_.stop);
          SizeRung          rung   = rung_of(scene, answer);
          for (std::size_t i = 0; i < outputs_.size(); ++i)
            if (const double share =
                    std::abs(answer.values[i] - finer_.values[i]) / (options_.tolerance * scale_of(i, finer_));
                share >= rung.share)
            {
              rung.share = share;
              rung.worst = outputs_[i].text;
            }
          if (!(here < place) && !(place < here))
            result.chosen_of_all = result.all.size();
          result.all.push_back(rung);
          if (options_.on_rung)
            options_.on_rung(rung);
        }
}

SizedModel Climb::run()
{
  Place place;
  place.modes = modes_are_chosen(scene_) ? first_modes : 0;
  place.time  = by_exact_ ? first_time : 2;
  SizedModel model;
  Place      best = place;
  while (true)
  {
    look(place);
    const SizeRung &rung = result_.ladder[rung_of_[place]];
    if (options_.max_cpu > 0. && rung.cpu_s > options_.max_cpu)
      result_.stopped = "a model takes " + short_text(rung.cpu_s, 2) + " s, above --max-cpu";
    else if (options_.max_memory > 0. && memory_taken() > options_.max_memory)
      result_.stopped = "the program took " + short_text(memory_taken() / 1e9, 2) + " GB, above --max-memory";
    if (!result_.stopped.empty())
      break;
    if (look(place).total <= look(best).total)
      best = place;
    if (fits(place))
    {
      coarsen(place);
      try_reductions(place);
      best        = place;
      result_.met = true;
      break;
    }
    if (until_thin_ && int(result_.ladder.size()) == thin_after && look(place).mesh > far_too_stiff)
    {
      result_.stopped = thin_walls;
      model.result    = result_;
      return model;
    }
    if (int(result_.ladder.size()) >= most_rungs || !finer(place))
    {
      result_.stopped = "the ladder ends here: nothing finer is at hand";
      break;
    }
  }
  result_.tolerance = options_.tolerance;
  result_.chosen    = rung_of_[best];
  model.chosen      = variant_of(best);
  model.result      = result_;
  prove(best, model);
  if (options_.exhaustive)
    try_all(best, model.result);
  question(best, model.result);
  return model;
}

} // namespace

SizedModel size_search(const Scene &scene, const std::vector<OutputName> &outputs, const SizeOptions &options)
{
  const bool may_sweep = mesh_is_made(scene) && scene.frame.geometry.mesh.plates != fem::Plates::swept;
  SizedModel model     = Climb(scene, outputs, options, may_sweep).run();
  if (model.result.met || !may_sweep || (options.stop && *options.stop))
    return model;
  // Thin walls, which are too stiff as tetrahedra.
  const Scene swept = varied(scene, {1., -1, {}, {}, true});
  SizedModel  other = Climb(swept, outputs, options, false).run();
  if (other.result.met)
  {
    other.chosen.swept = true;
    other.result.swept = true;
    return other;
  }
  return model.result.stopped == thin_walls ? Climb(scene, outputs, options, false).run() : model;
}

} // namespace gestell::apps

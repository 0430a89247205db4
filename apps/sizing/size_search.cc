#include "apps/sizing/size_search.h"

#include "apps/sizing/omissions.h"
#include "apps/sizing/size_models.h"
#include "coupling/frame/frame_cache.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <tuple>

namespace gestell::apps
{

namespace
{

constexpr double aim          = 0.8; ///< of the tolerance, because laws have errors
constexpr double of_a_part    = 0.2; ///< of the allowed error: modes and time are cheap compared with the mesh,
constexpr double without_mesh = 0.5; ///< of modes where there is none to be made finer
constexpr double most_runs    = 10.; ///< of the chosen model, that a search may take

constexpr double no_limit = std::numeric_limits<double>::infinity(); ///< of the cost or the error of a model

class Search
{
public:
  Search(const Scene &scene, const std::vector<OutputName> &outputs, const SizeOptions &options)
      : scene_(scene), outputs_(outputs), options_(options), models_(scene, outputs, options.tolerance, options.stop)
  {
  }

  SizedModel run();

private:
  const SizedPlace        &judge(const SizePlace &place, double most_cells = 0.);
  void                     find_kinds();
  std::vector<MeshPoint>   points_of(Cells cells) const;
  double                   of_modes() const { return mesh_can_change(scene_) ? of_a_part : without_mesh; }
  void                     plan(const SizedPlace &last);
  void                     keep_few_modes(const SizedPlace &coarse);
  std::optional<MeshPoint> expected(SizePlace &place) const;
  void                     try_kind(double coordinates);
  SizedPlace              *best() { return best_of(judged_); }
  bool                     is_confirmed();
  bool                     is_known();
  bool                     is_worth(const SizePlace &place, double coordinates);
  void                     forecast(double coordinates, double model_cpu, double work);
  void                     stop_above(double cpu);
  bool                     may_cost(const SizePlace &place, const MeshPoint &next);
  void                     search();
  double                   spent() const { return coupling::cpu_time_without_cache() - begin_; } ///< [s]
  void                     question(const SizedPlace &chosen);
  void                     try_all(const SizedPlace &chosen);

  const Scene                   &scene_;
  const std::vector<OutputName> &outputs_;
  const SizeOptions             &options_;
  const double                   begin_ = coupling::cpu_time_without_cache(); ///< [s]
  SizeModels                     models_;
  std::vector<Cells>             kinds_ = {Cells::given}, untried_; ///< of meshes
  std::deque<SizedPlace>         judged_;
  SizePlace                      planned_;                  ///< modes and time of the next model
  std::vector<Shares>            others_;                   ///< shares of error expected with it
  double                         coarsest_ = coarsest_mesh; ///< with a frame
  SizeResult                     result_;
};

const SizedPlace &Search::judge(const SizePlace &place, double most_cells)
{
  judged_.push_back(models_.judge(place, most_cells));
  if (options_.on_rung)
    options_.on_rung(judged_.back().rung);
  return judged_.back();
}

/// Other kinds of mesh.  Without the error of straight sides, which is known, they equal curved ones.
void Search::find_kinds()
{
  if (!mesh_can_change(scene_))
    return;
  const fem::MeshOptions &mesh = scene_.frame.geometry.mesh;
  if (mesh_is_made(scene_) && mesh.plates == fem::Plates::swept)
  {
    if (mesh.layers == 1) // a key only for swept plates
      untried_ = {Cells::curved};
    return;
  }
  if (sides_of(scene_, models_.answers().planes()) == Sides::straight)
    kinds_.push_back(Cells::curved);
  if (mesh_is_made(scene_) &&
      sides_of(varied(scene_, {1., -1, {}, {}, Cells::swept}), models_.answers().planes()) == Sides::exact)
    untried_ = {Cells::swept};
}

std::vector<MeshPoint> Search::points_of(Cells cells) const
{
  const bool             given_is_straight = scene_.frame.geometry.mesh.plates != fem::Plates::swept;
  std::vector<MeshPoint> points;
  for (const SizedPlace &judged : judged_)
    if (judged.place.cells == cells ||
        (cells == Cells::curved && judged.place.cells == Cells::given && given_is_straight))
    {
      points.push_back(judged.point);
      for (Shares &shares : points.back().shares)
        shares.sides = judged.place.cells == cells ? shares.sides : 0.;
    }
  return points;
}

/// More modes and a finer integration where these take too much.
void Search::plan(const SizedPlace &last)
{
  const auto  &shares = last.point.shares;
  const double modes = largest(shares, &Shares::modes), time = largest(shares, &Shares::time);
  planned_                = last.place;
  constexpr double enough = 1.5; // times the part of one cause: only above is it made smaller
  if (planned_.modes >= 0 && modes > enough * of_modes())
    planned_.modes = std::min(models_.most_modes(), modes_for(of_modes(), last.place.modes, modes));
  if (time > enough * of_a_part)
  {
    const SizeModels::TimeLaw law = models_.time_law();
    const double rungs = std::isfinite(time) ? std::log(time / of_a_part) / (law.order * std::log(law.factor)) : 1.;
    planned_.time      = std::max(law.finest, planned_.time / std::pow(law.factor, std::max(1., std::ceil(rungs))));
  }
  others_.assign(shares.size(), {});
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    others_[i].modes = planned_.modes == last.place.modes ? shares[i].modes : std::min(of_modes(), shares[i].modes);
    others_[i].time  = planned_.time == last.place.time ? shares[i].time : std::min(of_a_part, shares[i].time);
  }
}

/// Reduces the number of modes to that sufficient on the coarse frame, whose first modes are those of smaller ones.
void Search::keep_few_modes(const SizedPlace &coarse)
{
  SizePlace  all  = coarse.place;
  const bool more = planned_.modes > coarse.place.modes;
  if (planned_.modes <= 0)
    return;
  double rest = 0.; // share of mesh and time in the coarse model
  for (const Shares &shares : coarse.point.shares)
    rest = std::max(rest, shares.mesh() + shares.time);
  const double part              = std::max(of_modes(), aim - rest);
  all.modes                      = planned_.modes;
  const ModelAnswer       full   = models_.answers().of(models_.variant_of(all));
  const std::vector<int> &ladder = mode_ladder();
  const auto              at     = [&](int modes) { return std::lower_bound(ladder.begin(), ladder.end(), modes); };
  auto low = more ? at(coarse.place.modes) : ladder.begin() - 1, high = at(all.modes); // all from `high` on suffice
  while (high - low > 1)
  {
    const auto          middle = low + (high - low) / 2;
    ModelVariant        fewer  = models_.variant_of(all);
    std::vector<Shares> others = others_;
    double              most   = no_limit;
    fewer.made                 = fewer.modes;
    fewer.modes                = *middle;
    try
    {
      const ModelAnswer answer = models_.answers().of(fewer);
      for (std::size_t i = 0; i < outputs_.size(); ++i)
        others[i].modes =
            (more ? 0. : coarse.point.shares[i].modes) +
            std::abs(answer.values[i] - full.values[i]) / (options_.tolerance * models_.scale_of(i, full));
      most = largest(others, &Shares::modes);
    }
    catch (const std::exception &) // the motion needs more
    {
      if (options_.stop && *options_.stop)
        throw;
    }
    if (most <= part)
    {
      high           = middle;
      others_        = others;
      planned_.modes = *middle;
    }
    else
      low = middle;
  }
}

/// The next model, of the kind of mesh that needs the fewest coordinates.
std::optional<MeshPoint> Search::expected(SizePlace &place) const
{
  std::optional<MeshPoint> fewest;
  for (const Cells cells : kinds_)
  {
    const auto points = points_of(cells);
    if (points.empty())
      continue;
    const auto next =
        mesh_can_change(scene_) ? coarsest_within(aim, points, others_, coarsest_) : std::optional(points.front());
    if (!next || (fewest && next->coordinates > 0.95 * fewest->coordinates))
      continue;
    fewest      = next;
    place       = planned_;
    place.mesh  = mesh_can_change(scene_) ? std::floor(1e3 * next->size) / 1e3 : 1.;
    place.cells = cells;
  }
  return fewest;
}

/// Judges one of the kinds that were not tried, unless it has more coordinates even where it is coarse.
void Search::try_kind(double coordinates)
{
  SizePlace place = planned_;
  place.mesh      = coarsest_;
  place.cells     = untried_.back();
  untried_.pop_back();
  // Coordinates that a cell brings at least: a tetrahedron of a solid 4.1, a hexahedron of one layer 15.
  constexpr double of_tetrahedron = 4., of_hexahedron = 12.;
  const double     of_a_cell = place.cells == Cells::swept ? of_hexahedron : of_tetrahedron;
  const double     most      = std::isfinite(coordinates) ? coordinates / of_a_cell : 0.;
  try
  {
    const int n = models_.answers().of(models_.variant_of(place, most)).n_frame;
    if (n >= coordinates || n == judged_.front().model.run.n_frame) // the same mesh, as plates cannot be swept
      return;
    kinds_.push_back(place.cells);
    plan(judge(place, most));
  }
  catch (const std::exception &)
  {
    if (options_.stop && *options_.stop)
      throw;
  }
}

/// Whether the best model so far, if any, agrees with its answer on elements of 2/3 the size; otherwise the errors of
/// that model are estimated.
bool Search::is_confirmed()
{
  SizedPlace *so_far = best();
  if (!so_far || so_far->confirmed || !mesh_can_change(scene_))
    return true;
  SizePlace finer = so_far->place;
  finer.mesh      = std::floor(1e3 * finer.mesh / ratio_of_meshes) / 1e3;
  try
  {
    models_.compare(*so_far, models_.answers().of(models_.variant_of(finer)));
    if (so_far->rung.share <= 1.)
      return true;
    if (options_.on_rung)
      options_.on_rung(so_far->rung);
    plan(judge(finer));
    return false;
  }
  catch (const std::exception &) // too many cells, or cells that fold
  {
    if (options_.stop && *options_.stop)
      throw;
    so_far->confirmed = true;
    return true;
  }
}

/// Whether the error of one of the first models is known: if in all of them events have another order, finer ones cost
/// more without more information.
bool Search::is_known()
{
  constexpr int seen_enough = 3; // models without a known error: the next would have none either
  if (int(judged_.size()) < seen_enough ||
      std::any_of(judged_.begin(), judged_.end(), [](const auto &judged) { return std::isfinite(judged.rung.share); }))
    return true;
  for (const BudgetEntry &entry : judged_.back().rung.entries)
    for (const BudgetPart *part : {&entry.mesh, &entry.reduction, &entry.time})
      if (!part->error)
        result_.stopped =
            "the errors of all models are unknown; in the last model, " + entry.output + ": " + part->reason;
  return false;
}

/// Whether to estimate the errors of a model: a new one, smaller than the best so far.
bool Search::is_worth(const SizePlace &place, double coordinates)
{
  if (std::any_of(judged_.begin(), judged_.end(), [&](const SizedPlace &other) { return other.place == place; }))
    return false;
  const SizedPlace *so_far   = best();
  constexpr double  worth_it = 0.8; // ratio of coordinates below which a smaller model is also tried
  return !so_far || coordinates < worth_it * so_far->point.coordinates ||
         (place.cells == so_far->place.cells && place.mesh == so_far->place.mesh && place.modes < so_far->place.modes);
}

void Search::forecast(double coordinates, double model_cpu, double work)
{
  constexpr double of_finer_cells = 2.6; // CPU time of cells of 2/3 the size in walls, 1.5^(2 1.2)
  const double     proof          = mesh_can_change(scene_) ? of_finer_cells : 0.;
  SizeForecast    &reported       = result_.forecast;
  reported = {coordinates, planned_.modes, model_cpu, spent(), spent() + (work + proof + 1.) * model_cpu};
  if (options_.on_forecast)
    options_.on_forecast(reported);
}

/// Ends the search if a given limit is exceeded.
void Search::stop_above(double cpu)
{
  if (options_.max_cpu > 0. && cpu > options_.max_cpu)
    result_.stopped = "the next model takes " + short_text(cpu, 2) + " s, above --max-cpu";
  else if (options_.max_memory > 0. && memory_taken() > options_.max_memory)
    result_.stopped = "the program took " + short_text(memory_taken() / 1e9, 2) + " GB, above --max-memory";
}

bool Search::may_cost(const SizePlace &place, const MeshPoint &next)
{
  const SizedPlace &last = judged_.back();
  const double cpu = next.cpu_s + last.model.run.run_cpu * (models_.by_steps() ? last.place.time / place.time : 1.);
  forecast(next.coordinates, cpu, models_.has_frames(place) ? 1. : last.work);
  stop_above(cpu);
  return result_.stopped.empty() && (!best() || result_.forecast.runs() <= most_runs);
}

void Search::search()
{
  const SizePlace coarse = planned_     = models_.coarse();
  coarsest_                             = coarse.mesh;
  const ModelAnswer &answer             = models_.answers().of(models_.variant_of(coarse));
  constexpr double   models_of_a_budget = 4.; // models of about the same cost: sides, degree, modes, time
  forecast(answer.n_frame, answer.cpu(), models_of_a_budget);
  stop_above(answer.cpu());
  plan(judge(coarse));
  if (!result_.stopped.empty())
    return;
  keep_few_modes(judged_.front());
  constexpr int most_judged = 12; // bounds a search that its laws mislead
  find_kinds();
  while (int(judged_.size()) < most_judged && is_known())
  {
    SizePlace        place;
    const auto       next         = expected(place);
    const double     limit        = next ? next->coordinates : best() ? best()->point.coordinates : no_limit;
    constexpr double another_kind = 2.; // times the coordinates of the first model, from which others are tried
    if (!untried_.empty() && limit >= another_kind * judged_.front().point.coordinates)
    {
      try_kind(limit);
      continue;
    }
    if (!next || !is_worth(place, next->coordinates) || !may_cost(place, *next))
    {
      if (!result_.stopped.empty() || is_confirmed())
        break;
      continue;
    }
    try
    {
      plan(judge(place));
    }
    catch (const std::exception &failure)
    {
      const bool goes_on = models_.skip(place, failure);
      if ((options_.stop && *options_.stop) || (place.cells == Cells::given && !goes_on))
        throw;
      if (place.cells == Cells::given)
        coarsest_ = 0.9 * place.mesh; // a little finer
      else
        kinds_.erase(std::find(kinds_.begin(), kinds_.end(), place.cells));
    }
  }
}

void Search::question(const SizedPlace &chosen)
{
  const ModelAnswer &answer = chosen.model.run;
  const Scene        scene  = varied(scene_, models_.variant_of(chosen.place)),
              coarse        = varied(scene_, models_.variant_of(judged_.front().place));
  QuestionedModel model{scene, answer, outputs_, {}, options_.tolerance, coarse, judged_.front().model.run, {}};
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    model.scales.push_back(models_.scale_of(i, answer));
  constexpr double not_worth_counting = 5.; // [s] that a search may take of machines that run in a moment
  if (!options_.exhaustive)                 // and the last run
    model.affords = [&](double cpu)
    { return spent() + cpu + answer.cpu() <= std::max(most_runs * answer.cpu(), not_worth_counting); };
  const Omissions found                                        = find_omissions(model, options_.stop);
  std::tie(result_.left_out, result_.missing, result_.unasked) = std::tie(found.left_out, found.missing, found.unasked);
}

/// Compares every model up to one level finer than the chosen one in each part with the finest of its budget.
void Search::try_all(const SizedPlace &chosen)
{
  const ModelAnswer &finer = chosen.model.finest;
  for (const SizePlace &place : models_.about(chosen.place, judged_.front().place))
  {
    const ModelAnswer answer = models_.answers().of(models_.variant_of(place));
    SizeRung          rung   = models_.rung_of(place, answer);
    for (std::size_t i = 0; i < outputs_.size(); ++i)
      if (const double share =
              std::abs(answer.values[i] - finer.values[i]) / (options_.tolerance * models_.scale_of(i, finer));
          share >= rung.share)
      {
        rung.share = share;
        rung.worst = outputs_[i].text;
      }
    if (place == chosen.place)
      result_.chosen_of_all = result_.all.size();
    result_.all.push_back(rung);
    if (options_.on_rung)
      options_.on_rung(rung);
  }
}

SizedModel Search::run()
{
  search();
  SizedPlace *best_of_all = best();
  result_.met             = best_of_all && !(options_.max_cpu > 0. && best_of_all->model.run.cpu() > options_.max_cpu);
  if (result_.met)
    result_.stopped.clear();
  else if (result_.stopped.empty())
    result_.stopped = "no finer model is available";
  SizedPlace &chosen = best_of_all ? *best_of_all
                                   : *std::min_element(judged_.begin(), judged_.end(),
                                                       [](const SizedPlace &a, const SizedPlace &b)
                                                       { return a.rung.share < b.rung.share; });
  models_.settle(chosen);
  for (const SizedPlace &judged : judged_)
  {
    if (&judged == &chosen)
      result_.chosen = result_.ladder.size();
    result_.ladder.push_back(judged.rung);
  }
  const ModelAnswer &finer = chosen.model.finest;
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    result_.proof.push_back({outputs_[i].text, finer.units[i], chosen.model.run.values[i], finer.values[i]});
  result_.finer     = chosen.model.what;
  result_.tolerance = options_.tolerance;
  result_.skipped   = models_.skipped();
  question(chosen);
  result_.cpu_s = spent();
  if (options_.exhaustive)
    try_all(chosen);
  return {result_, models_.variant_of(chosen.place)};
}

} // namespace

SizedModel size_search(const Scene &scene, const std::vector<OutputName> &outputs, const SizeOptions &options)
{
  return Search(scene, outputs, options).run();
}

} // namespace gestell::apps

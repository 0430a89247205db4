#include "apps/analysis/life/life_damage.h"

#include "apps/analysis/life/damage/plane_search.h"
#include "apps/analysis/life/damage/point_stress.h"
#include "apps/analysis/life/life_rules.h"
#include "apps/analysis/life/life_skin.h"
#include "apps/analysis/life/weld_points.h"
#include "coupling/frame/stress_field.h"
#include "coupling/machine/own_modes.h"
#include "fem/values/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using coupling::ReducedFrame;
using coupling::ReducedStress;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Points that are judged by one curve.
struct LifeGroup
{
  std::string                  name;
  const ReducedStress         *stress = nullptr;
  DamageRule                   rule;
  DamageSearch                 search;
  double                       strength = 0.; ///< [Pa] R_m of the curve; 0: not given
  std::vector<int>             skin;          ///< [points] of the frame's skin; empty: they are these
  std::optional<ReducedStress> own{};         ///< of a weld
  std::vector<std::string>     doubts{};      ///< warnings about the weld

  int skin_point(int i) const { return skin.empty() ? i : skin[std::size_t(i)]; }
};

constexpr int worst_of_skin = 5; ///< places that are listed: a screen with those of welds

LifeGroup group_of_skin(const LifeRequest &life, const ReducedFrame &frame, const LifeSkin &skin, bool beside)
{
  constexpr double apart = 0.05; // of the frame: another place, not its neighbours
  LifeGroup        group;
  group.name              = skin_name;
  group.stress            = &frame.stress;
  group.rule              = damage_rule(life, life.curve, StressKind::direct);
  group.strength          = life.curve.strength.value_or(0.);
  group.search.measure    = measure_of(life);
  group.search.directions = skin.directions;
  group.search.position   = skin.position;
  group.search.counts     = points_by_rigid(frame.stress, beside);
  group.search.worst      = beside ? 1 : worst_of_skin;
  group.search.distance   = apart * skin.size;
  return group;
}

LifeGroup group_of_weld(const LifeRequest &life, const WeldRequest &weld, const Scene &scene, const ReducedFrame &frame,
                        const LifeSkin &skin)
{
  const bool          directed = weld.surfaces.size() == 2 || weld.direction;
  const CurveRequest &curve    = weld.curve ? *weld.curve : life.curve;
  WeldPoints          points   = weld_points(weld, scene.frame.geometry.surfaces, frame.stress, skin);
  LifeGroup           group;
  group.name              = weld.name;
  group.rule              = damage_rule(life, curve, weld.shear ? StressKind::shear : StressKind::direct);
  group.strength          = curve.strength.value_or(0.);
  group.search.measure    = !directed ? measure_of(life) : weld.shear ? StressMeasure::shear : StressMeasure::normal;
  group.search.counts     = std::vector<char>(points.position.size(), 1);
  group.search.directions = std::move(points.directions);
  group.search.position   = std::move(points.position);
  group.skin              = std::move(points.skin);
  group.own               = std::move(points.stress);
  group.doubts            = std::move(points.doubts);
  return group;
}

/// Damage of states at a place, on the plane found there.
double damage_there(const LifeGroup &group, const PointDamage &at, const MatrixXd &states, const LoadSequence &load,
                    double factor = 1.)
{
  DamageSearch search = group.search;
  search.factor *= factor;
  return damage_of(count_cycles(stress_history(*group.stress, states, search, at), load), group.rule);
}

double ratio_of_lives(double a, double b)
{
  return a == b ? 1. : std::max(a / b, b / a);
}

double largest_von_mises(const ReducedStress &stress, const MatrixXd &states, int point)
{
  const MatrixXd S = von_mises_and_trace().topRows<5>() * stress.mean.middleRows<6>(6 * Index(point)).cast<double>();
  return std::sqrt((S * states).colwise().squaredNorm().maxCoeff());
}

/// Every second sample of each block.
LifeLoad half_as_many(const LifeLoad &load)
{
  std::vector<std::int64_t> chosen;
  for (const LoadBlock &block : load.sequence.blocks)
    for (std::int64_t k = block.first; k < block.end; k += 2)
      chosen.push_back(k);
  return thinned(load, chosen);
}

/// Loads for the error of a life.
struct OtherLoads
{
  LifeLoad         coarse;
  OtherCoordinates fixed; ///< of modes fixed at the interfaces
  VectorXd         omega; ///< theirs [rad/s]
};

/// With the columns of an acceleration field.
MatrixXd with_field(const MatrixXd &T)
{
  MatrixXd whole                          = MatrixXd::Identity(T.rows() + 3, T.cols() + 3);
  whole.topLeftCorner(T.rows(), T.cols()) = T;
  return whole;
}

OtherLoads other_loads(const ReducedFrame &frame, const LifeLoad &load)
{
  const auto fixed = coupling::fixed_mode_coordinates(frame);
  OtherLoads others{half_as_many(load), {}, fixed.omega};
  if (fixed.T.size() > 0)
    others.fixed = {with_field(fixed.T), with_field(fixed.inverse) * load.states};
  return others;
}

/// Parts of statics, which is that of all interfaces (of each alone rigid motions would be a part), and of modes, by
/// size; a percent or less is left out.
std::vector<std::pair<std::string, double>> named_shares(const ReducedFrame &frame, const VectorXd &omega,
                                                         const VectorXd &shares)
{
  std::vector<std::pair<std::string, double>> named{{"statics", shares.head(frame.n_interface).sum()}};
  for (Index j = frame.n_interface; j < frame.M.rows(); ++j)
  {
    const Index mode = j - frame.n_interface;
    named.emplace_back("mode " + std::to_string(mode + 1) +
                           (mode < omega.size()
                                ? " fixed at the interfaces, " + short_text(omega[mode] / (2. * M_PI), 3) + " Hz"
                                : ""),
                       shares[j]);
  }
  using Share = std::pair<std::string, double>;
  named.erase(std::remove_if(named.begin(), named.end(), [](const Share &one) { return std::abs(one.second) <= 0.01; }),
              named.end());
  std::stable_sort(named.begin(), named.end(),
                   [](const auto &a, const auto &b) { return std::abs(a.second) > std::abs(b.second); });
  return named;
}

LifePlace place_of(const LifeGroup &group, const PointDamage &at, const ReducedFrame &frame, const LifeLoad &load,
                   const OtherLoads &others)
{
  const VectorXd           history = stress_history(*group.stress, load.states, group.search, at);
  const std::vector<Cycle> cycles  = count_cycles(history, load.sequence);
  LifePlace                place;
  place.of      = group.name;
  place.point   = at.point;
  place.at      = group.search.position[std::size_t(at.point)];
  place.damage  = damage_of(cycles, group.rule);
  place.life    = repetitions_to_failure(place.damage);
  place.strokes = place.life * load.strokes;
  place.hours   = place.life * load.service / 3600.;
  if (group.search.measure == StressMeasure::critical_plane)
    place.direction = plane_normal(at.row);
  else if (!group.search.directions.empty() && group.search.measure != StressMeasure::signed_von_mises)
  {
    const SurfaceDirections &there = group.search.directions[std::size_t(at.point)];
    place.direction                = there.normal.cross(there.weld);
  }
  constexpr double rounding = 1e-6; // of the largest stress: they are recovered in single precision
  const Cycle     *largest  = nullptr;
  for (const Cycle &cycle : cycles)
    if (!largest || cycle.range > largest->range)
      largest = &cycle;
  for (const Cycle &cycle : cycles)
  {
    place.cycles += cycle.range > rounding * (largest->range + std::abs(largest->mean)) ? cycle.count : 0.;
    if (const double cut_off = group.rule.curve.cut_off(); cut_off > 0.)
      place.utilisation = std::max(place.utilisation, group.rule.equivalent_range(cycle) / cut_off);
  }
  const int skin_point = group.skin_point(at.point);
  if (largest)
  {
    place.range        = place.cycles > 0. ? largest->range : 0.;
    place.mean         = largest->mean;
    place.disagreement = coupling::disagreement(frame.stress, load.states.col(largest->end), skin_point);
  }
  place.row       = at.row;
  place.strength  = group.strength;
  place.von_mises = largest_von_mises(*group.stress, load.states, at.point);
  if (const int nearby = frame.stress.nearby[std::size_t(skin_point)]; nearby >= 0)
    place.nearby = frame.stress.rigid[std::size_t(nearby)];
  const auto damage = [&](const MatrixXd &states, const LoadSequence &sequence, double factor)
  { return damage_there(group, at, states, sequence, factor); };
  if (!(place.damage > 0.))
  {
    if (damage(load.states, load.sequence, 1. + place.disagreement) > 0.)
      place.error.mesh = std::numeric_limits<double>::infinity();
    return place;
  }
  if (std::isinf(place.damage)) // life_warnings() gives the reason
    return place;
  place.error.mesh = ratio_of_lives(damage(load.states, load.sequence, 1. + place.disagreement), place.damage);
  const double turning =
      damage_of(count_cycles(extremes_between_samples(history, load.sequence), load.sequence), group.rule);
  place.error.time =
      std::max(std::cbrt(ratio_of_lives(damage(others.coarse.states, others.coarse.sequence, 1.), place.damage)),
               std::pow(ratio_of_lives(turning, place.damage), 1. / found_between_samples));
  place.shares = named_shares(
      frame, others.omega,
      damage_shares(*group.stress, load.states, load.sequence, group.rule, group.search, at, others.fixed));
  return place;
}

/// The worst points; without damage those of the largest ranges.
std::vector<PointDamage> worst_of(const LifeGroup &group, const LifeLoad &load, LifeResult &result)
{
  DamageRule  rule  = group.rule;
  WorstPoints found = worst_points(*group.stress, load.states, load.sequence, rule, group.search);
  if (!found.worst.empty() && !(found.worst.front().damage > 0.))
  {
    rule.miner = Miner::elementary;
    found      = worst_points(*group.stress, load.states, load.sequence, rule, group.search);
  }
  const auto idle = [](const PointDamage &one) { return !(one.damage > 0.); };
  found.worst.erase(std::remove_if(found.worst.begin(), found.worst.end(), idle), found.worst.end());
  for (PointDamage &one : found.worst)
    one = on_worst_plane(*group.stress, load.states, load.sequence, rule, group.search, one);
  result.n_points += int(std::count(group.search.counts.begin(), group.search.counts.end(), 1));
  result.looked_at += found.looked_at;
  return found.worst;
}

/// Cycles, matrix and history at a place, and how the load closes.
void add_course(const LifeGroup &group, const PointDamage &at, const LifeLoad &load, LifeResult &result)
{
  const VectorXd            history = stress_history(*group.stress, load.states, group.search, at);
  const std::vector<Cycle>  cycles  = count_cycles(history, load.sequence);
  const std::vector<double> damage  = damage_per_cycle(cycles, group.rule);
  constexpr int             classes = 24; // cells of a picture of which each is still seen
  result.rule                       = group.rule;
  result.matrix                     = range_mean_matrix(cycles, damage, classes);
  for (std::size_t k = 0; k < cycles.size(); ++k)
    result.cycles.push_back({cycles[k].range, cycles[k].mean, cycles[k].count, damage[k],
                             load.t[std::size_t(cycles[k].begin)], load.t[std::size_t(cycles[k].end)]});
  std::stable_sort(result.cycles.begin(), result.cycles.end(),
                   [](const LifeCycle &a, const LifeCycle &b)
                   { return std::pair(a.damage, a.range) > std::pair(b.damage, b.range); });
  const Index n = load.sequence.blocks.front().end;
  result.t.assign(load.t.begin(), load.t.begin() + n);
  result.stress.assign(history.data(), history.data() + n);
  const double span = history.head(n).maxCoeff() - history.head(n).minCoeff();
  if (span > 0.)
    result.closing = std::abs(history[n - 1] - history[0]) / span;
  if (load.before.cols() > 0)
  {
    const auto of = [&](const MatrixXd &states)
    { return damage_there(group, at, states, single_load(states.cols(), Residue::repeated)); };
    const double last = of(load.states.leftCols(n)), before = of(load.before), most = std::max(last, before);
    result.stroke_change = most > 0. ? std::abs(last - before) / most : 0.;
  }
}

/// Samples that turn the stress at the worst places or are extremes of a coordinate.
std::vector<std::int64_t> telling_samples(const std::vector<std::pair<const LifeGroup *, PointDamage>> &worst,
                                          const LifeLoad                                               &load)
{
  constexpr std::size_t  enough = 300; // a hundredth of those of a run; the rest of a place's cycles is small
  std::set<std::int64_t> chosen;
  for (const LoadBlock &block : load.sequence.blocks)
  {
    chosen.insert({block.first, block.end - 1});
    for (Index j = 0; j < load.states.rows(); ++j)
    {
      Index      least, most;
      const auto part = load.states.row(j).segment(block.first, block.end - block.first);
      part.minCoeff(&least);
      part.maxCoeff(&most);
      chosen.insert({block.first + least, block.first + most});
    }
  }
  for (const auto &[group, at] : worst)
  {
    std::vector<Cycle> cycles =
        count_cycles(stress_history(*group->stress, load.states, group->search, at), load.sequence);
    std::sort(cycles.begin(), cycles.end(), [](const Cycle &a, const Cycle &b) { return a.range > b.range; });
    const std::size_t before = chosen.size();
    for (std::size_t k = 0; k < cycles.size() && chosen.size() < before + enough / worst.size(); ++k)
      chosen.insert({cycles[k].begin, cycles[k].end});
  }
  return {chosen.begin(), chosen.end()};
}

/// Damage at every point, of few states: not above the damage of all.
void add_field(const LifeGroup &group, const ReducedFrame &frame, const LifeLoad &few, LifeField &field)
{
  field.points    = frame.points;
  field.triangles = frame.triangles;
  field.n_states  = int(few.n_samples());
  field.damage.assign(frame.points.size(), 0.);
  for (int i = 0; i < frame.stress.n_points(); ++i)
  {
    double &there = field.damage[std::size_t(frame.stress.point[std::size_t(i)])];
    there = std::max(there, point_damage(*group.stress, few.states, few.sequence, group.rule, group.search, i).damage);
  }
}

/// The skin away from rigid surfaces and next to them, if it has a curve; the welds.
std::vector<LifeGroup> groups_of(const Scene &scene, const ReducedFrame &frame, const LifeSkin &skin)
{
  const LifeRequest     &life = *scene.life;
  std::vector<LifeGroup> groups;
  if (!life.curve.place.empty())
    groups = {group_of_skin(life, frame, skin, false), group_of_skin(life, frame, skin, true)};
  for (const WeldRequest &weld : life.welds)
    groups.push_back(group_of_weld(life, weld, scene, frame, skin));
  for (LifeGroup &group : groups)
    group.stress = group.own ? &*group.own : &frame.stress;
  return groups;
}

} // namespace

LifeResult life_of(const Scene &scene, const ReducedFrame &frame, const LifeLoad &load)
{
  const LifeRequest &life = *scene.life;
  const LifeSkin     skin = skin_of(frame);
  LifeResult         result;
  result.asked                                                  = life;
  result.service                                                = load.service;
  result.strokes                                                = load.strokes;
  result.n_states                                               = long(load.n_samples());
  result.step                                                   = load.step;
  const bool                                             all    = !life.curve.place.empty();
  const std::vector<LifeGroup>                           groups = groups_of(scene, frame, skin);
  const OtherLoads                                       others = other_loads(frame, load);
  std::vector<std::pair<const LifeGroup *, PointDamage>> worst;
  for (const LifeGroup &group : groups)
  {
    result.warnings.insert(result.warnings.end(), group.doubts.begin(), group.doubts.end());
    for (const PointDamage &at : worst_of(group, load, result))
    {
      LifePlace place = place_of(group, at, frame, load, others);
      if (all && &group == &groups[1])
      {
        result.beside_rigid = std::move(place);
        continue;
      }
      worst.emplace_back(&group, at);
      result.places.push_back(std::move(place));
    }
  }
  if (result.places.empty())
    return result;
  std::vector<std::size_t> order(worst.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return result.places[a].damage > result.places[b].damage; });
  add_course(*worst[order.front()].first, worst[order.front()].second, load, result);
  std::stable_sort(result.places.begin(), result.places.end(),
                   [](const LifePlace &a, const LifePlace &b) { return a.damage > b.damage; });
  if (all)
    add_field(groups.front(), frame, thinned(load, telling_samples(worst, load)), result.field);
  return result;
}

std::vector<double> damages_at(const Scene &scene, const ReducedFrame &frame, const LifeLoad &load,
                               const LifePlace &place)
{
  constexpr double here = 1e-3; // of the frame: the same point of a mesh that moves with a dimension
  const LifeSkin   skin = skin_of(frame);
  for (const LifeGroup &group : groups_of(scene, frame, skin))
    if (const auto at = std::size_t(place.point); group.name == place.of && at < group.search.position.size())
      if ((group.search.position[at] - place.at).norm() <= here * skin.size)
      {
        const VectorXd x      = stress_history(*group.stress, load.states, group.search, {place.point, 0., place.row});
        const auto     cycles = count_cycles(extremes_between_samples(x, load.sequence), load.sequence);
        return damage_per_cycle(cycles, group.rule);
      }
  throw std::runtime_error("the frame of an additional run has a different mesh, without this point");
}

} // namespace gestell::apps

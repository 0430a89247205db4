#include "apps/session/stress_answer.h"

#include "coupling/frame/stress_search.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

using coupling::KeptState;
using coupling::ReducedFrame;
using coupling::ReducedStress;
using Eigen::VectorXd;

/// All states that were kept.
std::vector<const KeptState *> states_of(const coupling::KeptStates &kept)
{
  std::vector<const KeptState *> states;
  for (const auto *group : {&kept.grid, &kept.at, &kept.extremes})
    for (const KeptState &state : *group)
      if (state.q.size() > 0)
        states.push_back(&state);
  return states;
}

std::vector<char> away_from_rigid(const ReducedStress &stress)
{
  std::vector<char> away(stress.nearby.size());
  std::transform(stress.nearby.begin(), stress.nearby.end(), away.begin(), [](int nearby) { return nearby < 0; });
  if (std::find(away.begin(), away.end(), 1) == away.end())
    away.assign(away.size(), 1); // a frame of few elements
  return away;
}

const KeptState *of_largest_stress(const Scene &scene, const ReducedStress &stress,
                                   const std::vector<const KeptState *> &states)
{
  if (states.empty())
    return nullptr;
  Eigen::MatrixXd columns(stress.mean.cols(), Eigen::Index(states.size()));
  for (std::size_t k = 0; k < states.size(); ++k)
    columns.col(Eigen::Index(k)) = coupling::stress_state(stress, states[k]->q, scene.gravity);
  const auto found = coupling::largest_von_mises(stress, columns, away_from_rigid(stress));
  return states[found.peak.state];
}

/// The largest of the points that count.
std::optional<StressPlace> place_of_largest(const ReducedFrame &frame, const VectorXd &state,
                                            const coupling::StressField &field, const std::vector<char> &counts)
{
  const ReducedStress &stress = frame.stress;
  int                  top    = -1;
  for (int i = 0; i < stress.n_points(); ++i)
    if (counts[i] && (top < 0 || field.von_mises[i] > field.von_mises[top]))
      top = i;
  if (top < 0)
    return {};
  const auto       &x      = frame.points[stress.point[top]];
  const std::string nearby = stress.nearby[top] >= 0 ? stress.rigid[stress.nearby[top]] : "";
  return StressPlace{{x[0], x[1], x[2]},
                     field.von_mises[top],
                     coupling::principal_stresses(field.at(top)),
                     coupling::disagreement(stress, state, top),
                     nearby};
}

StressAt stress_at(const Scene &scene, const ReducedFrame &frame, const std::string &label, const KeptState &kept)
{
  const ReducedStress &stress = frame.stress;
  const VectorXd       state  = coupling::stress_state(stress, kept.q, scene.gravity);
  StressAt             result;
  result.label           = label;
  result.t               = kept.t;
  result.field           = coupling::stress_field(stress, state);
  std::vector<char> away = away_from_rigid(stress), nearby(away.size());
  std::transform(away.begin(), away.end(), nearby.begin(), [](char is_away) { return !is_away; });
  result.peak         = place_of_largest(frame, state, result.field, away);
  result.beside_rigid = place_of_largest(frame, state, result.field, nearby);

  const VectorXd u = frame.displacement.cast<double>() * kept.q.head(frame.displacement.cols());
  result.displacement.resize(3, stress.n_points());
  for (int i = 0; i < stress.n_points(); ++i)
    result.displacement.col(i) = u.segment<3>(3 * Eigen::Index(stress.point[i]));
  return result;
}

std::string words_of_disagreement(const StressAt &instant)
{
  const StressPlace &peak = *instant.peak;
  return "the largest stress " + (instant.label.empty() ? "" : "(" + instant.label + ") ") + "at " +
         short_text(instant.t) + " s, " + short_text(1e-6 * peak.von_mises) + " MPa at (" + short_text(peak.at[0]) +
         " " + short_text(peak.at[1]) + " " + short_text(peak.at[2]) +
         ") is uncertain: neighbouring elements disagree by " + short_text(100. * peak.disagreement, 2) +
         " % (above 10 % the mesh is too coarse); refine it there";
}

} // namespace

void require_stress(const Scene &scene, const ReducedFrame *frame)
{
  if (scene.stress.given && (!frame || frame->stress.empty()))
    throw std::invalid_argument(scene.stress.place + ": the reduced frame contains no stresses; create it again by "
                                                     "`gestell reduce` from a scene with [output.stress]");
}

StressResult stress_answer(const Scene &scene, const ReducedFrame &frame, const coupling::RunResult &run,
                           std::vector<std::string> &warnings)
{
  StressResult result;
  for (const int point : frame.stress.point)
    result.points.emplace_back(frame.points[point][0], frame.points[point][1], frame.points[point][2]);
  result.triangles  = frame.stress.triangles;
  const auto states = states_of(run.states);
  for (const StressInstant &instant : scene.stress.instants)
  {
    const KeptState *kept = nullptr;
    if (instant.when == StressInstant::largest_stress)
    {
      kept            = of_largest_stress(scene, frame.stress, states);
      result.n_states = static_cast<int>(states.size());
      result.step     = scene.run.options.states.step;
    }
    else
      kept = &(instant.when == StressInstant::time ? run.states.at : run.states.extremes)[instant.index];
    if (!kept || kept->q.size() == 0)
    {
      warnings.push_back("the stress " + (instant.label.empty() ? "at " + short_text(kept->t) + " s" : instant.label) +
                         " is missing: the run ended before");
      continue;
    }
    const auto same = std::find_if(result.instants.begin(), result.instants.end(),
                                   [&](const StressAt &other) { return other.t == kept->t; });
    if (same == result.instants.end())
      result.instants.push_back(stress_at(scene, frame, instant.label, *kept));
    else
      same->label += (same->label.empty() || instant.label.empty() ? "" : ", ") + instant.label;
  }
  std::stable_sort(result.instants.begin(), result.instants.end(),
                   [](const StressAt &a, const StressAt &b) { return a.t < b.t; });
  for (const StressAt &instant : result.instants)
    if (instant.peak && instant.peak->disagreement > resolved_disagreement)
      warnings.push_back(words_of_disagreement(instant));
  return result;
}

} // namespace gestell::apps

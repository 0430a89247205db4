#include "apps/analysis/life/life_warnings.h"

#include "apps/output/values/stress_result.h"
#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{
namespace
{

std::string position_of(const LifePlace &place)
{
  return "(" + short_text(place.at[0]) + " " + short_text(place.at[1]) + " " + short_text(place.at[2]) + ")";
}

/// One warning that names the places for which `words` has any.
template <typename Words>
void add_of_places(const LifeResult &found, const std::string &begin, const std::string &end, const Words &words,
                   std::vector<std::string> &warnings)
{
  std::string list;
  for (const LifePlace &place : found.places)
    if (const std::string own = words(place); !own.empty())
      list += (list.empty() ? "" : "; ") + position_of(place) + " of " + place.of + ", where " + own;
  if (!list.empty())
    warnings.push_back("life: " + begin + list + ". " + end);
}

/// Places with damage, or with damage within their error.
void add_unresolved(const LifeResult &found, std::vector<std::string> &warnings)
{
  const auto words = [](const LifePlace &place) -> std::string
  {
    const bool cracks = place.damage > 0. || !std::isfinite(place.error.mesh);
    if (!cracks || place.disagreement <= resolved_disagreement)
      return "";
    return "the stresses of neighbouring elements differ by " + percent(place.disagreement, 2) +
           (std::isfinite(place.error.mesh) ? ", a factor of " + short_text(place.error.mesh, 3) + " on life"
                                            : ", enough for damage");
  };
  add_of_places(found, "the mesh does not resolve ",
                "Refine it there (mesh.size of a surface), or use the hot-spot stress for a weld", words, warnings);
}

/// Linear elasticity ends at the yield strength, which is below R_m.
void add_beyond_strength(const LifeResult &found, std::vector<std::string> &warnings)
{
  constexpr double mega  = 1e6;
  const auto       words = [&](const LifePlace &place) -> std::string
  {
    if (!(place.strength > 0.) || place.von_mises <= place.strength)
      return "";
    return "the von Mises stress reaches " + short_text(place.von_mises / mega, 3) + " MPa, but R_m is " +
           short_text(place.strength / mega, 3) + " MPa";
  };
  add_of_places(found, "linear elasticity and S-N curves are not valid at ",
                "The material yields there: reduce the load or the notch", words, warnings);
}

} // namespace

std::vector<std::string> life_warnings(const Scene &scene, const LifeResult &found)
{
  std::vector<std::string> warnings = found.warnings;
  const LifePlace         *worst    = found.worst();
  if (!worst)
    return {"life: no cycle was counted: there is no stress, or all points of the mesh are next to rigid surfaces; "
            "refine the mesh"};
  if (worst->cycles == 0.)
    warnings.push_back("life: no cycle was counted: the stress does not change between output.from and the end of the "
                       "run; a life needs a load that rises and falls");
  add_unresolved(found, warnings);
  add_beyond_strength(found, warnings);
  constexpr double rounding = 1e-4; // of a damage: that of stresses in single precision times the slope
  if (found.beside_rigid &&
      found.beside_rigid->damage > (worst->damage > 0. ? (1. + rounding) * worst->error.total() * worst->damage : 0.))
    warnings.push_back("life: the damage at " + position_of(*found.beside_rigid) + ", next to " +
                       found.beside_rigid->nearby + ", is larger, " + short_text(found.beside_rigid->damage, 3) +
                       ", but the stress at the edge of a rigid surface is singular, so no mesh resolves it; use "
                       "coupling = \"average\", or the hot-spot stress for a weld");
  constexpr double steady = 0.05; // of the damage: 1.6 % of the range with slope 3
  if (found.stroke_change > steady)
    warnings.push_back("life: the run ends before the steady state: the damage of the last two windows differs by " +
                       percent(found.stroke_change, 2) + "; increase run.end, now " +
                       short_text(scene.run.options.end) +
                       " s, or start on the periodic solution (start.rule = \"periodic\")");
  if (found.closing > steady)
    warnings.push_back("life: the stress at the end of the load differs from that at its start by " +
                       percent(found.closing, 2) +
                       " of its range, so the load does not repeat smoothly; count one period only (output.from), or "
                       "let the run end in its initial state");
  if (std::isinf(worst->damage))
    warnings.push_back("life: no life is left at " + position_of(*worst) + ": " +
                       (found.asked.mean_stress == "goodman"
                            ? "the mean stress of a cycle reaches the tensile strength (mean_stress = \"goodman\"); "
                              "check the unit of 'strength' and the load"
                            : "the damage exceeds all numbers; check the S-N curve, its factors and the load"));
  if (worst->cycles > 0. && worst->cycles <= 1. && found.closing > steady)
    warnings.push_back("life: " + short_text(worst->cycles) +
                       " cycle was counted at the worst place: the run contains only one rise and fall, so "
                       "smaller repeated cycles are not counted");
  return warnings;
}

} // namespace gestell::apps

#pragma once

#include "apps/analysis/life/damage/damage.h"
#include "apps/output/describe/described.h"
#include "apps/output/report/section.h"
#include "apps/output/text/csv.h"
#include "apps/scene/values/life_request.h"

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Factors on life, >= 1: true lives are between life / factor and life * factor.
struct LifeError
{
  double                mesh = 1., time = 1.;
  std::optional<double> modes; ///< known by further runs only

  double total() const { return mesh * time * modes.value_or(1.); }
};

template <class Visitor>
void describe(Visitor &v, const LifeError &x)
{
  v("mesh", x.mesh, "1", "stress higher by the disagreement of neighbouring elements");
  v("modes", x.modes, "1", "twice the modes; null without `--life-error`");
  v("time", x.time, "1",
    "a third of what every second state changes, or extremes between states; finer integration with `--life-error`");
  v("total", x.total(), "1", "product of those that are known");
}

/// A place and its damage in one repetition of the load.
struct LifePlace
{
  std::string     of;                                  ///< "skin" or the name of a weld
  int             point     = -1;                      ///< of the skin or the weld
  Eigen::Vector3d at        = Eigen::Vector3d::Zero(); ///< [m]
  Eigen::Vector3d direction = Eigen::Vector3d::Zero(); ///< of the normal stress; zero: it has none
  double          damage    = 0.;
  double          life      = std::numeric_limits<double>::infinity(); ///< repetitions of the load until failure
  double          strokes = life, hours = life;                        ///< the same
  double          cycles = 0.;                                         ///< counted; 0: the stress is constant
  double          range = 0., mean = 0.;                               ///< [Pa] largest range, and its mean
  double          utilisation  = 0.; ///< largest equivalent range over the cut-off of the curve; without one 0
  double          disagreement = 0.;
  double          von_mises    = 0.; ///< [Pa] largest of the load
  double          strength     = 0.; ///< [Pa] R_m of the curve; 0: not given
  Eigen::Matrix<double, 1, 6>                 row = Eigen::Matrix<double, 1, 6>::Zero(); ///< of a linear measure
  std::string                                 nearby; ///< what makes the surface rigid beside it; "": nothing
  LifeError                                   error;
  std::vector<std::pair<std::string, double>> shares; ///< in the damaging ranges, by size
};

template <class Visitor>
void describe_life(Visitor &v, const LifePlace &x)
{
  v("damage", x.damage, "1", "damage of one repetition of the load; failure is at 1");
  v("life", x.life, "1", "repetitions of the load until failure; null: no damage");
  v("strokes", x.strokes, "1", "strokes until failure; null: no damage");
  v("hours", x.hours, "h", "time in service until failure; null: no damage");
}

template <class Visitor>
void describe(Visitor &v, const LifePlace &x)
{
  v("of", x.of, "", "skin, or name of the weld");
  v("at", x.at, "m", "position x, y, z");
  v("direction", x.direction, "1", "direction of the normal stress; zero: none");
  describe_life(v, x);
  v("cycles", x.cycles, "1", "counted cycles of one repetition");
  v("range", x.range, "Pa", "largest range");
  v("mean", x.mean, "Pa", "its mean stress");
  v("utilisation", unless_zero(x.utilisation), "1",
    "largest range, corrected for its mean, over the cut-off of the curve; null: it has none");
  v("disagreement", x.disagreement, "1", "disagreement of neighbouring elements, relative");
  v("von_mises", x.von_mises, "Pa", "largest von Mises stress");
  v("beside", x.nearby, "", "support or interface that makes the surface rigid there; empty: none");
  v("factor", x.error, "", "error as a factor on life");
  v("shares", x.shares, "1", "parts of modes and of static deflections in the damaging ranges");
}

/// A cycle at the worst place.
struct LifeCycle
{
  double range = 0., mean = 0., count = 0., damage = 0.; ///< Pa, Pa
  double begin = 0., end = 0.;                           ///< [s] of its two turning points
};

template <class Visitor>
void describe(Visitor &v, const LifeCycle &x)
{
  v("range", x.range, "Pa", "range");
  v("mean", x.mean, "Pa", "mean stress");
  v("count", x.count, "1", "how often in one repetition of the load");
  v("damage", x.damage, "1", "its damage");
  v("t_begin", x.begin, "s", "first turning point");
  v("t_end", x.end, "s", "second turning point");
}

/// A number at every point of the picture of the frame.
struct LifeField
{
  std::vector<std::array<double, 3>> points; ///< [m]
  std::vector<std::array<int, 3>>    triangles;
  std::vector<double>                damage;       ///< of one repetition; empty: only welds are judged
  int                                n_states = 0; ///< of which it is made
};

/// Of the life at the worst place.
struct LifeDerivative
{
  std::string key;
  double      exponent = std::numeric_limits<double>::quiet_NaN(); ///< d ln(life) / d ln(key)
  double      error    = std::numeric_limits<double>::quiet_NaN(); ///< of the differences
  std::string note{};
};

template <class Visitor>
void describe(Visitor &v, const LifeDerivative &x)
{
  v("key", x.key, "", "key of the scene");
  v("exponent", x.exponent, "1", "d ln(life) / d ln(key): percent of life for a percent of the key");
  v("error", x.error, "1", "its error, by differences over twice the distance");
  v("note", x.note, "", "why it is doubtful; empty: it is not");
}

struct LifeResult
{
  DamageRule                   rule; ///< of the worst place
  LifeRequest                  asked;
  std::vector<LifePlace>       places;                     ///< by damage
  std::optional<LifePlace>     beside_rigid;               ///< worst next to rigid surfaces
  double                       service = 0., strokes = 0.; ///< of one repetition [s]
  std::vector<LifeCycle>       cycles;                     ///< at the worst place, by damage
  RangeMeanMatrix              matrix;
  std::vector<double>          t, stress; ///< of the run of this scene there [s, Pa]
  double                       closing       = std::numeric_limits<double>::quiet_NaN();
  double                       stroke_change = std::numeric_limits<double>::quiet_NaN();
  LifeField                    field;
  int                          n_points = 0, looked_at = 0;
  long                         n_states = 0;
  double                       step = 0., cpu_s = 0.;
  bool                         refined = false; ///< errors of modes and time are those of further runs
  std::vector<LifeDerivative>  derivatives{};
  std::vector<std::string>     warnings{}; ///< about the stresses of welds
  std::function<std::string()> states{};   ///< content of life_states.bin; empty: they are not of a run

  const LifePlace *worst() const { return places.empty() ? nullptr : &places.front(); }
};

template <class Visitor>
void describe(Visitor &v, const LifeResult &x)
{
  const LifePlace worst = x.places.empty() ? LifePlace() : x.places.front();
  describe_life(v, worst);
  v("factor", worst.error.total(), "1", "error as a factor on life; without `--life-error` that of mesh and sampling");
  v("curve", x.rule.curve.name, "", "S-N curve of the worst place");
  v("measure", x.asked.measure, "", "stress that is counted without a direction");
  v("mean_stress", x.asked.mean_stress, "", "correction for mean stresses");
  v("miner", x.asked.miner, "", "rule of Palmgren and Miner");
  v("residue", x.asked.residue, "", "ranges that no cycle closes");
  v("service", x.service, "s", "time in service of one repetition");
  v("strokes_each", x.strokes, "1", "strokes of one repetition");
  v("closing", x.closing, "1", "difference of the stress between end and start of the load, over its range");
  v("stroke_change", x.stroke_change, "1",
    "damage of the window before, relative difference; null: the run does not contain it");
  v("places", x.places, "", "worst places, by damage");
  v.maybe(x.beside_rigid.has_value(), "beside_rigid", x.beside_rigid, "", "worst place next to rigid surfaces");
  v("refined", x.refined, "", "whether further runs gave the errors of modes and time, `--life-error`");
  v.maybe(!x.derivatives.empty(), "derivatives", x.derivatives, "", "`--life-by`");
  v("points", x.n_points, "", "points searched");
  v("evaluated", x.looked_at, "", "points whose cycles had to be counted; bounds exclude the others");
  v("states", x.n_states, "", "states counted");
  v("step", x.step, "s", "interval between them");
  v("cpu_s", x.cpu_s, "s", "CPU time beyond the run");
}

template <class Visitor>
void describe_answer(Visitor &v, const LifeResult &x)
{
  v.maybe(true, "life", x, "", "fatigue of the frame, `[life]`");
}

std::vector<Section> sections_of(const Result &result, const LifeResult &found);
Headline             headline_of(const LifeResult &found);

CsvTable    life_places_csv(const LifeResult &found);
CsvTable    life_cycles_csv(const LifeResult &found);
std::string life_vtp(const LifeResult &found);

} // namespace gestell::apps

#include "coupling/periodic/basins.h"

#include "coupling/periodic/period_flow.h"
#include "coupling/periodic/trace_orbit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::VectorXd;

/// A motion that starts may settle to: its states (Omega q, q') at the begins of all its periods.
struct Attractor
{
  int                   number = 0;
  std::vector<VectorXd> states;
  double                radius = 0.;
};

std::vector<VectorXd> begins_of(const PeriodicProblem &one, const PeriodicSolution &solution)
{
  std::vector<VectorXd> states;
  PeriodicProblem       own = one;
  own.period                = solution.period;
  own.turn                  = solution.turn;
  own.ratio                 = solution.ratio;
  trace(own, solution, solution.ratio,
        [&](const OrbitPoint &point)
        {
          const double periods = double(states.size());
          VectorXd     x(2 * point.q.size());
          x << 2. * M_PI / one.period * without_free(one, point.q - periods / solution.ratio * solution.turn), point.v;
          states.push_back(x);
        });
  states.pop_back(); // the first again
  return states;
}

double distance(const std::vector<VectorXd> &some, const std::vector<VectorXd> &others)
{
  double least = std::numeric_limits<double>::infinity();
  for (const VectorXd &a : some)
    for (const VectorXd &b : others)
      least = std::min(least, (a - b).norm());
  return least;
}

/// @param widest  size of a start, for a motion that is rest
std::vector<Attractor> attractors_of(const PeriodicProblem &one, const std::vector<PeriodicSolution> &solutions,
                                     double widest)
{
  std::vector<std::vector<VectorXd>> states;
  for (const PeriodicSolution &solution : solutions)
    states.push_back(begins_of(one, solution));
  std::vector<Attractor> attractors;
  for (std::size_t k = 0; k < solutions.size(); ++k)
  {
    if (!solutions[k].stable())
      continue;
    double reach = 0.;
    for (const VectorXd &state : states[k])
      reach = std::max(reach, state.norm());
    reach = reach > 0. ? reach : widest;
    for (std::size_t other = 0; other < solutions.size(); ++other)
      if (other != k)
        reach = std::min(reach, distance(states[k], states[other]));
    constexpr double near_motion = 0.01; // of its size and of its distance to other motions
    attractors.push_back({int(k) + 1, states[k], near_motion * reach});
  }
  if (attractors.empty())
    throw std::invalid_argument("basins: none of the periodic solutions found is stable, so no motion settles to them");
  return attractors;
}

/// Of the starts' two numbers, in (Omega q, q').
double widest_of(const StartPlane &plane, Index n, double omega)
{
  const auto scale = [&](int i) { return i < n ? omega : 1.; };
  return std::hypot(scale(plane.x) * std::max(std::abs(plane.x_begin), std::abs(plane.x_end)),
                    scale(plane.y) * std::max(std::abs(plane.y_begin), std::abs(plane.y_end)));
}

std::vector<Basins::Place> places_of(const std::vector<Attractor> &attractors, const StartPlane &plane, double omega)
{
  std::vector<Basins::Place> places;
  for (const Attractor &attractor : attractors)
    for (const VectorXd &state : attractor.states)
    {
      const auto at = [&](int i) { return i < state.size() / 2 ? state[i] / omega : state[i]; };
      places.push_back({attractor.number, plane.x_sign * at(plane.x), plane.y_sign * at(plane.y)});
    }
  return places;
}

/// Settles from start to start.
class Settler
{
public:
  Settler(const PeriodicProblem &one, std::vector<Attractor> attractors, const MethodOptions &integration, int most)
      : one_(one), attractors_(std::move(attractors)), flow_(one_, integration), most_(most)
  {
    for (const Attractor &attractor : attractors_)
      for (const VectorXd &state : attractor.states)
        largest_ = std::max(largest_, state.norm());
  }

  /// @return number of the motion
  int settle(VectorXd q, VectorXd v)
  {
    constexpr double lost = 1e4; // sizes of the largest motion and start: a state there has run away
    const double     far  = lost * std::max(largest_, state_of(q, v).norm());
    for (periods_ = 0; periods_ <= most_; ++periods_)
    {
      const VectorXd x = state_of(q, v);
      if (const int number = reached(x); number > 0)
        return number;
      if (!(x.norm() < far) || periods_ == most_)
        break;
      try
      {
        const PeriodPassage &passage = flow_.pass(q, v, one_.period, false);
        q                            = passage.q - one_.turn;
        v                            = passage.v;
        work_.add({0, 1, passage.work});
      }
      catch (const ConvergenceFailure &)
      {
        break;
      }
    }
    return Basins::not_reached;
  }
  int                 periods() const { return periods_; } ///< of the last start
  const PeriodicWork &work() const { return work_; }

private:
  VectorXd state_of(const VectorXd &q, const VectorXd &v) const
  {
    VectorXd x(2 * q.size());
    x << 2. * M_PI / one_.period * without_free(one_, q), v;
    return x;
  }
  int reached(const VectorXd &x) const
  {
    for (const Attractor &attractor : attractors_)
      for (const VectorXd &state : attractor.states)
        if ((x - state).norm() <= attractor.radius)
          return attractor.number;
    return 0;
  }

  const PeriodicProblem &one_;
  std::vector<Attractor> attractors_;
  PeriodFlow             flow_;
  double                 largest_ = 0.;
  int                    most_, periods_ = 0;
  PeriodicWork           work_;
};

void require_plane(const PeriodicProblem &problem, const StartPlane &plane)
{
  if (problem.period_is_unknown())
    throw std::invalid_argument("basins: the period is unknown, so initial states differ in their phase only; basins "
                                "need a machine whose loads determine the period");
  if (plane.points < 1 || plane.x == plane.y || !(plane.x_end > plane.x_begin) || !(plane.y_end > plane.y_begin))
    throw std::invalid_argument(
        "basins: the initial states need two different coordinates, each from a value to a larger value");
}

} // namespace

double Basins::share(int solution) const
{
  const auto looked_at = (motion.array() != not_looked_at).count();
  return looked_at > 0 ? double((motion.array() == solution).count()) / double(looked_at) : 0.;
}

Basins basins_of(const PeriodicProblem &problem, const std::vector<PeriodicSolution> &solutions,
                 const PeriodicGuess &rest, const StartPlane &plane, const PeriodicOptions &options,
                 const std::function<void(double)> &progress)
{
  require_plane(problem, plane);
  PeriodicProblem one             = problem.of_one_period();
  constexpr long  steps_of_period = 20000; // more are taken by a motion that has run away
  one.most_steps                  = steps_of_period;
  MethodOptions    integration    = options.integration;
  constexpr double settled_finely = 1e-8; // tolerance of the steps: attractors are told apart to 1 %
  if (!(integration.step > 0.))
    integration.tolerance = std::max(integration.tolerance, settled_finely);
  const Index                  n          = rest.q.size();
  const double                 omega      = 2. * M_PI / one.period;
  const std::vector<Attractor> attractors = attractors_of(one, solutions, widest_of(plane, n, omega));
  Settler                      settler(one, attractors, integration, options.periods);
  Basins                       basins{plane, places_of(attractors, plane, omega), {}, {}, {}};
  basins.motion.setConstant(plane.points, plane.points, Basins::not_looked_at);
  basins.periods.setZero(plane.points, plane.points);
  VectorXd start(2 * n);
  start << rest.q, rest.v;
  try
  {
    for (int j = 0; j < plane.points; ++j)
      for (int i = 0; i < plane.points; ++i)
      {
        start[plane.x]       = plane.x_sign * plane.x_at(i);
        start[plane.y]       = plane.y_sign * plane.y_at(j);
        basins.motion(i, j)  = settler.settle(start.head(n), start.tail(n));
        basins.periods(i, j) = settler.periods();
        progress((j + (i + 1.) / plane.points) / plane.points);
      }
  }
  catch (const SearchInterrupted &)
  {
    // what was found is kept
  }
  basins.work = settler.work();
  return basins;
}

} // namespace gestell::coupling

#include "coupling/periodic/shooting/shooting_method.h"

#include "coupling/integration/step/consistent_start.h"
#include "coupling/integration/step/varied_motion.h"
#include "coupling/periodic/newton.h"
#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting/multiple_shooting.h"
#include "coupling/periodic/shooting/shooting.h"

#include <functional>
#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::VectorXd;

/// The matrix at z.
void form(ShootingEquations &equations, DominantSubspace &slow, const VectorXd &z)
{
  const PeriodPassage &passage = equations.evaluate_with(z, slow.dq(), slow.dv());
  slow.take(passage.monodromy, equations.rate_at_end());
}

/// Newton's method from z until the motion closes to `goal`, on the steps of `equations`. Its matrix is reused while
/// the motion closes well; of a step by an earlier matrix the whole alone is tried. Iterations are the steps tried.
NewtonResult close(ShootingEquations &equations, const std::function<void(const VectorXd &)> &evaluate,
                   DominantSubspace &slow, const PeriodicProblem &problem, VectorXd &z, double goal, int most)
{
  int        tried  = 0;
  bool       here   = false; // the matrix is that of z
  double     before = 0., after = 0.;
  const auto step = [&](NewtonResult &) -> NewtonStep
  {
    if (equations.closing() <= goal || tried == most || problem.interrupted())
      return {};
    constexpr double good        = 0.3;  // residual after a step, of that before, with which its matrix is kept
    constexpr double fewer       = 0.1;  // of the share, where the motion does not close well
    constexpr double least_share = 1e-4; // below it all motions are slow
    const bool       kept        = tried == 0 ? slow.formed() : after / before < good;
    if (!kept && here && !slow.all())
      slow.choose(slow.share() > least_share ? fewer * slow.share() : 0., problem.period);
    if (!kept)
      form(equations, slow, z);
    here = !kept;
    ++tried;
    before                         = equations.residual().norm();
    constexpr double smallest_part = 1e-3; // of a step that is halved ten times: then the direction does not help
    return {-slow.correction(equations.residual()), before, 0.1, 1., here ? smallest_part : 0.5};
  };
  const auto length = [&](const VectorXd &next)
  {
    evaluate(next);
    return after = equations.residual().norm();
  };
  evaluate(z);
  NewtonResult newton;
  do
    newton = solve_by_newton(z, most, step, length);
  while (newton.stalled && !(here && slow.all()));
  newton.converged  = equations.closing() <= goal;
  newton.iterations = tried;
  return newton;
}

} // namespace

PeriodicSolution shoot_slow(const PeriodicProblem &problem, DominantSubspace &slow, PeriodicGuess near,
                            const PeriodicOptions &options)
{
  MethodOptions    coarse       = options.integration;
  constexpr double coarse_steps = 1e-6; // tolerance of the steps at first: as far as the motion then closes
  coarse.tolerance              = std::max(coarse.tolerance, coarse_steps);
  const double      omega       = 2. * M_PI / problem.period;
  ShootingEquations roughly(problem, coarse, omega), finely(problem, options.integration, omega);
  lead_in(roughly.flow(), problem, options, near);
  VectorXd z = roughly.unknowns(near.q, near.v, near.period);
  // residual at which the fine steps begin: the coarse ones err by as much
  constexpr double   coarse_goal      = 1e-6;
  const auto         evaluate_roughly = [&](const VectorXd &next) { roughly.evaluate(next, false); };
  const NewtonResult first = close(roughly, evaluate_roughly, slow, problem, z, coarse_goal, options.iterations);
  if (!slow.formed())
    form(roughly, slow, z);
  LargestMultipliers multipliers(slow.dominant(), omega);
  const auto         evaluate = [&](const VectorXd &next)
  { multipliers.take(finely.evaluate_with(next, multipliers.dq(), multipliers.dv()).monodromy); };
  const NewtonResult last =
      first.converged ? close(finely, evaluate, slow, problem, z, options.tolerance, options.iterations) : first;
  if (!last.converged)
  {
    ShootingEquations all(problem, options.integration);
    return shoot(all, problem, all.unknowns(near.q, near.v, near.period), options);
  }
  constexpr int ritz_rounds = 6; // of iteration: a share of 0.1 falls to 1e-6
  for (int round = 0; round < ritz_rounds && !multipliers.converged(); ++round)
    evaluate(z);
  PeriodicSolution solution = finely.solution("shooting");
  solution.multipliers      = multipliers.values();
  solution.work.add(roughly.solution("shooting").work);
  solution.work.iterations = first.iterations + last.iterations;
  std::ostringstream note;
  note << "the " << solution.multipliers.size() << " largest multipliers are listed; motions that decay by more than "
       << 100. * (1. - slow.share()) << " % in a period have smaller ones";
  if (!multipliers.converged())
    note << "; the error of the largest is " << multipliers.leaves();
  solution.notes.push_back(note.str());
  return solution;
}

namespace
{

/// From a state at the end of the lead-in over the period in one passage.
PeriodicSolution shoot_once(const PeriodicProblem &problem, const PeriodicGuess &near, const PeriodicOptions &options)
{
  ShootingEquations equations(problem, options.integration);
  PeriodicSolution  found = shoot(equations, problem, equations.unknowns(near.q, near.v, near.period), options);
  refuse_rest(problem, near, found);
  return found;
}

/// Why joints cannot be closed at a neighbouring start: a singular M; empty: they can.
std::string why_no_start(const SecondOrderSystem &system)
{
  try
  {
    ConsistentStart(system, "shooting with ideal joints");
    return "";
  }
  catch (const std::invalid_argument &singular)
  {
    return std::string(singular.what()) + "; use --method settling";
  }
}

/// The same, else in segments.
PeriodicSolution shoot_any_way(const PeriodicProblem &problem, const PeriodicGuess &near,
                               const PeriodicOptions &options)
{
  std::string failure;
  try
  {
    return shoot_once(problem, near, options);
  }
  catch (const SearchInterrupted &)
  {
    throw;
  }
  catch (const UndeterminedMotion &)
  {
    throw;
  }
  catch (const NoPeriodicMotion &reason)
  {
    failure = reason.what();
  }
  catch (const ConvergenceFailure &reason)
  {
    failure = reason.what();
  }
  try
  {
    return shoot_in_segments(problem, near, options);
  }
  catch (const SearchInterrupted &)
  {
    throw;
  }
  catch (const NoPeriodicMotion &again)
  {
    throw NoPeriodicMotion(failure + "; " + again.what());
  }
}

class Shooting final : public PeriodicMethod
{
public:
  std::string name() const override { return "shooting"; }
  std::string meaning() const override
  {
    return "Newton's method on q(T) - q(0), q'(T) - q'(0) (5.5.4/1), its matrix by tangents integrated along with the "
           "motion, through events by saltation.";
  }
  std::string refuses(const PeriodicProblem &problem) const override
  {
    if (why_not_propagated(*problem.system, "settling").empty())
      return "";
    if (problem.system->forces().need_multipliers())
      return "shooting without the integrator's own tangents: friction depends on the forces of joints, whose tangents "
             "at slip and stick are not known; use --method settling";
    constexpr int most = 300; // DOFs: a period with the tangents of all costs as much as settling
    if (problem.turn.size() > most)
      return "shooting without the integrator's own tangents: " + std::to_string(problem.turn.size()) +
             " DOFs, above " + std::to_string(most) + "; use --method settling";
    const Eigen::Index measures = problem.system->forces().directions().cols() + problem.system->joints().n_rows();
    if (measures > VariedMotion::most_measures)
      return "shooting without the integrator's own tangents: " + std::to_string(measures) +
             " measures and equations of joints, above " + std::to_string(VariedMotion::most_measures) +
             "; use --method settling";
    return problem.system->joints().n_rows() > 0 ? why_no_start(*problem.system) : "";
  }
  std::vector<PeriodicOption> options() const override { return {lead_in_option()}; }
  bool                        integrates() const override { return true; }

  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override
  {
    PeriodFlow flow(problem, options.integration);
    // Of large frames segments would need the tangents of all motions.
    if (flow.has_tangents() && options.segments == 0)
      if (DominantSubspace motions(problem); mostly_fast(motions, problem))
        return {shoot_slow(problem, motions, guess, options)};
    PeriodicGuess near = guess;
    lead_in(flow, problem, options, near);
    if (options.segments > 0)
      return {shoot_in_segments(problem, near, options)};
    if (flow.has_tangents())
      return {shoot_any_way(problem, near, options)};
    return {shoot_once(problem, near, options)};
  }
};

} // namespace

const PeriodicMethod &shooting_method()
{
  static const Shooting method;
  return method;
}

} // namespace gestell::coupling

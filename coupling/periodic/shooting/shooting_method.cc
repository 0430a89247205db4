#include "coupling/periodic/shooting/shooting_method.h"

#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting/multiple_shooting.h"
#include "coupling/periodic/shooting/shooting.h"

#include <sstream>

namespace gestell::coupling
{

namespace
{
using Eigen::VectorXd;

/// Newton's method on steps of one fineness, its matrix kept while the motion closes well.
class ChordNewton
{
public:
  ChordNewton(const PeriodicProblem &problem, const MethodOptions &integration, DominantSubspace &slow, double omega)
      : problem_(problem), slow_(slow), equations_(problem, integration, omega)
  {
  }

  ShootingEquations &equations() { return equations_; }
  int                iterations() const { return iterations_; }
  /// Every evaluation improves them from now on.
  void watch(LargestMultipliers &multipliers) { multipliers_ = &multipliers; }
  /// From z until the motion closes to `goal`; whether it does.  A matrix that is not formed yet is formed at once.
  bool close(VectorXd &z, double goal, int most);
  void evaluate(const VectorXd &z);

  void form(const VectorXd &z);

private:
  double step(VectorXd &z, bool formed_here);

  const PeriodicProblem &problem_;
  DominantSubspace      &slow_;
  ShootingEquations      equations_;
  LargestMultipliers    *multipliers_ = nullptr;
  int                    iterations_  = 0;
};

void ChordNewton::evaluate(const VectorXd &z)
{
  if (multipliers_)
    multipliers_->take(equations_.evaluate_with(z, multipliers_->dq(), multipliers_->dv()).monodromy);
  else
    equations_.evaluate(z, false);
}

void ChordNewton::form(const VectorXd &z)
{
  const PeriodPassage &passage = equations_.evaluate_with(z, slow_.dq(), slow_.dv());
  slow_.take(passage.monodromy, equations_.rate_at_end());
}

/// z - part dz with the largest part of 1, 1/2, 1/4 ... that closes better, the whole alone if the matrix is an old
/// one; residual behind, of that before.
double ChordNewton::step(VectorXd &z, bool formed_here)
{
  const double     before        = equations_.residual().norm();
  const VectorXd   dz            = slow_.correction(equations_.residual());
  constexpr double smallest_part = 1e-3; // of a step that is halved ten times: then the direction does not help
  for (double part = 1.; part > smallest_part; part *= 0.5)
  {
    const VectorXd next = z - part * dz;
    try
    {
      evaluate(next);
      const double after = equations_.residual().norm();
      if (after < (1. - 0.1 * part) * before)
      {
        z = next;
        return after / before;
      }
    }
    catch (const ConvergenceFailure &)
    {
    }
    if (!formed_here)
      break;
  }
  evaluate(z);
  return 1.;
}

bool ChordNewton::close(VectorXd &z, double goal, int most)
{
  evaluate(z);
  bool here = !slow_.formed() && equations_.closing() > goal;
  if (here)
    form(z);
  while (equations_.closing() > goal && iterations_ < most && !problem_.interrupted())
  {
    ++iterations_;
    const double     left = step(z, here);
    constexpr double good = 0.3; // residual behind a step, of that before, with which its matrix is kept
    if (left < good || equations_.closing() <= goal)
    {
      here = false;
      continue;
    }
    if (here && slow_.all() && left >= 1.)
      return false;
    constexpr double fewer       = 0.1;  // of the share, where the motion does not close well
    constexpr double least_share = 1e-4; // below it all motions are slow
    if (here && !slow_.all())
      slow_.choose(slow_.share() > least_share ? fewer * slow_.share() : 0., problem_.period);
    form(z);
    here = true;
  }
  return equations_.closing() <= goal;
}

} // namespace

PeriodicSolution shoot_slow(const PeriodicProblem &problem, DominantSubspace &slow, PeriodicGuess near,
                            const PeriodicOptions &options)
{
  MethodOptions    coarse       = options.integration;
  constexpr double coarse_steps = 1e-6; // tolerance of the steps at first: as far as the motion then closes
  coarse.tolerance              = std::max(coarse.tolerance, coarse_steps);
  const double omega            = 2. * M_PI / problem.period;
  ChordNewton  roughly(problem, coarse, slow, omega), finely(problem, options.integration, slow, omega);
  lead_in(roughly.equations().flow(), problem, options, near);
  VectorXd z = roughly.equations().unknowns(near.q, near.v, near.period);
  // closing error at which the fine steps begin: the coarse ones err by as much
  constexpr double coarse_goal = 1e-6;
  const bool       closes      = roughly.close(z, coarse_goal, options.iterations);
  if (!slow.formed())
    roughly.form(z);
  LargestMultipliers multipliers(slow.dominant(), omega);
  finely.watch(multipliers);
  if (!closes || !finely.close(z, options.tolerance, options.iterations))
  {
    ShootingEquations all(problem, options.integration);
    return shoot(all, problem, all.unknowns(near.q, near.v, near.period), options);
  }
  constexpr int ritz_rounds = 6; // of iteration: a share of 0.1 falls to 1e-6
  for (int round = 0; round < ritz_rounds && !multipliers.converged(); ++round)
    finely.evaluate(z);
  PeriodicSolution solution = finely.equations().solution("shooting");
  solution.multipliers      = multipliers.values();
  solution.work.add(roughly.equations().solution("shooting").work);
  solution.work.iterations = roughly.iterations() + finely.iterations();
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

/// In segments, where `failure` is why one passage does not do.
PeriodicSolution shoot_again(const PeriodicProblem &problem, const PeriodicGuess &near, const PeriodicOptions &options,
                             const std::string &failure)
{
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

/// From a state behind the lead-in over the period in one passage, else in segments.
PeriodicSolution shoot_any_way(const PeriodicProblem &problem, const PeriodicGuess &near,
                               const PeriodicOptions &options)
{
  try
  {
    ShootingEquations equations(problem, options.integration);
    PeriodicSolution  found = shoot(equations, problem, equations.unknowns(near.q, near.v, near.period), options);
    refuse_rest(problem, near, found);
    return found;
  }
  catch (const SearchInterrupted &)
  {
    throw;
  }
  catch (const UndeterminedMotion &)
  {
    throw;
  }
  catch (const NoPeriodicMotion &failure)
  {
    return shoot_again(problem, near, options, failure.what());
  }
  catch (const ConvergenceFailure &failure)
  {
    return shoot_again(problem, near, options, failure.what());
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
    return why_not_propagated(*problem.system, "settling");
  }
  std::vector<PeriodicOption> options() const override { return {lead_in_option()}; }
  bool                        integrates() const override { return true; }

  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override
  {
    // Of large frames segments would need the tangents of all motions.
    if (DominantSubspace motions(problem); options.segments == 0 && mostly_fast(motions, problem))
      return {shoot_slow(problem, motions, guess, options)};
    PeriodicGuess near = guess;
    {
      PeriodFlow flow(problem, options.integration);
      lead_in(flow, problem, options, near);
    }
    if (options.segments > 0)
      return {shoot_in_segments(problem, near, options)};
    return {shoot_any_way(problem, near, options)};
  }
};

} // namespace

const PeriodicMethod &shooting_method()
{
  static const Shooting method;
  return method;
}

} // namespace gestell::coupling

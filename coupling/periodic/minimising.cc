#include "coupling/periodic/minimising.h"

#include "coupling/periodic/deflation.h"
#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting/shooting.h"
#include "coupling/periodic/trace_orbit.h"

#include <unsupported/Eigen/LevenbergMarquardt>

#include <algorithm>
#include <cmath>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::VectorXd;

constexpr double box_reach    = 5.;  ///< of the box, in the largest excursions of the motion that the guess leads to
constexpr double astray       = 4.;  ///< distance from the middle of the box, in its size, at which a start is lost
constexpr int    usual_starts = 64;  ///< twice: all solutions of a few coordinates are found by most of them
constexpr double off          = 0.3; ///< of the largest excursions: so far

/// M r, r of (5.5.4/2), for Eigen's minimiser.
class LeastSquares : public Eigen::DenseFunctor<double>
{
public:
  /// Motions farther than `far` from `middle` are not looked at.
  LeastSquares(ShootingEquations &equations, const VectorXd &middle, double far, const Deflation &deflation)
      : Eigen::DenseFunctor<double>(int(middle.size()), int(middle.size())), equations_(equations), middle_(middle),
        far_(far), deflation_(deflation)
  {
  }
  int operator()(const VectorXd &z, VectorXd &r) const
  {
    if (!evaluate(z, false))
      return -1;
    VectorXd slope;
    r = deflation_.factor(z, slope) * equations_.residual();
    return 0;
  }
  int df(const VectorXd &z, Eigen::MatrixXd &J) const
  {
    if (!evaluate(z, true))
      return -1;
    VectorXd     slope;
    const double factor = deflation_.factor(z, slope);
    J                   = factor * (equations_.jacobian() + equations_.residual() * slope.transpose());
    return 0;
  }

private:
  bool evaluate(const VectorXd &z, bool jacobian) const
  {
    if (!((z - middle_).norm() <= far_))
      return false;
    try
    {
      equations_.evaluate(z, jacobian);
    }
    catch (const ConvergenceFailure &)
    {
      return false;
    }
    return true;
  }

  ShootingEquations &equations_;
  VectorXd           middle_;
  double             far_;
  const Deflation   &deflation_;
};

/// Number k of Halton's sequence to the base b, in (0, 1).
double halton(int k, int b)
{
  double part = 1., value = 0.;
  for (; k > 0; k /= b)
  {
    part /= b;
    value += part * (k % b);
  }
  return value;
}

int prime(Index i)
{
  int found = 2;
  for (Index count = 0;; ++found)
  {
    bool is_prime = true;
    for (int d = 2; d * d <= found; ++d)
      is_prime = is_prime && found % d != 0;
    if (is_prime && count++ == i)
      return found;
  }
}

int starts_of(const PeriodicOptions &options)
{
  return int(options.value("starts", usual_starts));
}

/// Starts that search freely; the rest keeps off what is known.
int free_starts(const PeriodicOptions &options)
{
  constexpr int one_in = 4; // of so many starts one keeps off the motions that are known
  return starts_of(options) - starts_of(options) / one_in;
}

/// Largest excursions of a motion about its mean.
struct Box
{
  VectorXd q, v, q_half, v_half; ///< [n]

  VectorXd at(int k, Index i_first, const VectorXd &middle, const VectorXd &half) const
  {
    VectorXd x = middle;
    for (Index i = 0; i < x.size(); ++i)
      x[i] += half[i] * (2. * halton(k, prime(i_first + i)) - 1.);
    return x;
  }
};

Box box_about(const PeriodicProblem &problem, const PeriodicGuess &guess, const PeriodicOptions &options)
{
  constexpr int samples = 64; // of a period: extremes to (pi / 64)^2 / 2 = 0.1 %
  PeriodFlow    flow(problem, options.integration);
  const Index   n   = guess.q.size();
  VectorXd      low = VectorXd::Constant(n, 1e300), high = -low, fastest = VectorXd::Zero(n);
  flow.look_on(samples,
               [&](const OrbitPoint &point)
               {
                 const VectorXd q = point.q - (point.t - problem.begin) / problem.period * problem.turn;
                 low              = low.cwiseMin(q);
                 high             = high.cwiseMax(q);
                 fastest          = fastest.cwiseMax(point.v.cwiseAbs());
               });
  flow.pass(guess.q, guess.v, problem.period, false);
  const double   omega = 2. * M_PI / problem.period;
  const VectorXd half  = (0.5 * (high - low)).cwiseMax(fastest / omega);
  return {0.5 * (low + high), VectorXd::Zero(n), box_reach * half, box_reach * (half * omega).cwiseMax(fastest)};
}

class Minimising final : public PeriodicMethod
{
public:
  std::string name() const override { return "minimise"; }
  std::string meaning() const override
  {
    return "Least squares of (5.5.4/2) from many initial states in a box: all solutions found, each once, with the "
           "share of initial states that lead to it.";
  }
  std::string refuses(const PeriodicProblem &problem) const override
  {
    return why_not_propagated(*problem.system, "settling");
  }
  std::vector<PeriodicOption> options() const override
  {
    return {{"starts", "of minimise (default " + std::to_string(usual_starts) + ")", 1., 1e6}, lead_in_option()};
  }
  bool                          integrates() const override { return true; }
  bool                          finds_all() const override { return true; }
  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override;
};

/// States of a solution at the begins of its periods of the excitation, what turns taken off.
std::vector<std::pair<VectorXd, VectorXd>> phases_of(const PeriodicProblem &once, const PeriodicSolution &solution)
{
  const int                                  periods = solution.ratio / once.ratio;
  std::vector<std::pair<VectorXd, VectorXd>> phases;
  trace(once, solution, periods,
        [&](const OrbitPoint &point)
        {
          const double gone = (point.t - solution.begin) / solution.period;
          phases.emplace_back(point.q - gone * solution.turn, point.v);
        });
  phases.pop_back();
  return phases;
}

double apart(const PeriodicProblem &problem, double omega, const PeriodicSolution &a, const VectorXd &q,
             const VectorXd &v)
{
  return std::sqrt(omega * omega * without_free(problem, a.q - q).squaredNorm() + (a.v - v).squaredNorm());
}

/// The search of motions that repeat after some periods of the problem, from one start after the other.
class MotionSearch
{
public:
  MotionSearch(const PeriodicProblem &once, int periods, const Box &box, const PeriodicOptions &options,
               std::vector<PeriodicSolution> &found);

  void from_all_starts();

private:
  bool             descend(int k, VectorXd &z);
  void             take(PeriodicSolution solution, double share);
  void             keep_off(const PeriodicSolution &solution);
  PeriodicSolution shortest(const PeriodicSolution &solution) const;
  PeriodicSolution rising(const PeriodicSolution &solution) const;

  static PeriodicProblem repeated(PeriodicProblem problem, int periods)
  {
    problem.period *= periods;
    problem.turn *= periods;
    problem.ratio *= periods;
    return problem;
  }
  static MethodOptions rough(MethodOptions integration)
  {
    constexpr double coarse = 1e-6; // tolerance of the steps far from a solution: far below `promising`
    integration.tolerance   = std::max(integration.tolerance, coarse);
    return integration;
  }

  const PeriodicProblem         &once_;
  PeriodicProblem                problem_;
  const Box                     &box_;
  PeriodicOptions                options_;
  std::vector<PeriodicSolution> &found_;
  ShootingEquations              equations_, roughly_;
  VectorXd                       middle_;
  double                         far_, omega_;
  Deflation                      nothing_, known_;
};

MotionSearch::MotionSearch(const PeriodicProblem &once, int periods, const Box &box, const PeriodicOptions &options,
                           std::vector<PeriodicSolution> &found)
    : once_(once), problem_(repeated(once, periods)), box_(box), options_(options), found_(found),
      equations_(problem_, options.integration), roughly_(problem_, rough(options.integration)),
      middle_(equations_.unknowns(box.q, box.v, problem_.period)),
      far_(astray * equations_.unknowns(box.q_half, box.v_half, problem_.period).norm()),
      omega_(2. * M_PI / (problem_.period / problem_.ratio)), nothing_(1.), known_(off * far_ / (astray * box_reach))
{
  options_.iterations = 15;
  for (const PeriodicSolution &solution : found_)
    keep_off(solution);
}

void MotionSearch::keep_off(const PeriodicSolution &solution)
{
  const double period = problem_.period_is_unknown() ? solution.period : problem_.period;
  for (const auto &phase : phases_of(once_, solution))
    known_.add(equations_.unknowns(phase.first, phase.second, period));
}

void MotionSearch::from_all_starts()
{
  for (int k = 1; k <= starts_of(options_) && !problem_.interrupted(); ++k)
    try
    {
      VectorXd z;
      if (descend(k, z))
        take(shortest(shoot(equations_, problem_, z, options_)), k <= free_starts(options_) ? 1. : 0.);
    }
    catch (const std::runtime_error &)
    {
      // a start that leads nowhere
    }
}

/// From start k to where F is small; false: it is not.
bool MotionSearch::descend(int k, VectorXd &z)
{
  const bool    freely = k <= free_starts(options_);
  PeriodicGuess at{box_.at(k, 0, box_.q, box_.q_half), box_.at(k, box_.q.size(), box_.v, box_.v_half), problem_.period};
  if (freely && k % 2 == 0)
    lead_in(roughly_.flow(), problem_, options_, at);
  z = equations_.unknowns(at.q, at.v, at.period);
  LeastSquares                            squares(roughly_, middle_, far_, freely ? nothing_ : known_);
  Eigen::LevenbergMarquardt<LeastSquares> minimiser(squares);
  // of one minimisation: a start that gets nowhere by then is given up for another one
  constexpr int most_steps = 60;
  minimiser.setMaxfev(most_steps);
  minimiser.minimize(z);
  constexpr double promising = 0.01; // closing error below which Newton's method takes over
  return roughly_.closing() < promising;
}

/// A motion that repeats after one period already is one of one period; one that nothing tells the time begins where it
/// rises.  @throws NoPeriodicMotion if that is rest
PeriodicSolution MotionSearch::shortest(const PeriodicSolution &solution) const
{
  if (once_.period_is_unknown() && once_.turn.isZero(0.))
    return rising(solution);
  if (solution.ratio == once_.ratio || own_ratio(once_, solution) > once_.ratio)
    return solution;
  ShootingEquations equations(once_, options_.integration);
  return shoot(equations, once_, equations.unknowns(solution.q, solution.v, once_.period), options_);
}

/// Of the passages of a self-excited motion through its phase the next rising one.
PeriodicSolution MotionSearch::rising(const PeriodicSolution &solution) const
{
  constexpr double rest_speed = 1e-6; // of the speeds of the box: an equilibrium, but for the steps' errors
  if (!(solution.v.norm() > rest_speed * box_.v_half.norm()))
    throw NoPeriodicMotion("the motion is rest");
  if (solution.v[once_.phase] > 0.)
    return solution;
  PeriodFlow           flow(once_, options_.integration);
  const PeriodPassage &passage = flow.pass_turn(solution.q, solution.v, 1.5 * solution.period);
  ShootingEquations    equations(once_, options_.integration);
  return shoot(equations, once_, equations.unknowns(passage.q, passage.v, solution.period), options_);
}

/// Each motion once, begun in whatever period of the excitation.
void MotionSearch::take(PeriodicSolution solution, double share)
{
  for (const auto &phase : phases_of(once_, solution))
    for (PeriodicSolution &other : found_)
    {
      const double     size       = std::sqrt(omega_ * omega_ * other.q.squaredNorm() + other.v.squaredNorm());
      constexpr double same_orbit = 1e-6; // distance of two motions, of their size, within which they are one
      if (apart(once_, omega_, other, phase.first, phase.second) > same_orbit * std::max(size, 1e-300))
        continue;
      other.share += share;
      return;
    }
  solution.method = "minimise";
  solution.share  = share;
  keep_off(solution);
  found_.push_back(std::move(solution));
}

std::vector<PeriodicSolution> Minimising::solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                                const PeriodicOptions &options) const
{
  PeriodicGuess near = guess;
  {
    PeriodFlow flow(problem, options.integration);
    lead_in(flow, problem, options, near);
  }
  const Box                     box = box_about(problem, near, options);
  std::vector<PeriodicSolution> found;
  // of sub-harmonic motions that are looked for: higher ones are rare, and cost as many periods
  constexpr int highest_ratio = 3;
  const int     highest       = problem.period_is_unknown() || problem.ratio > 1 ? 1 : highest_ratio;
  for (int periods = 1; periods <= highest; ++periods)
    MotionSearch(problem, periods, box, options, found).from_all_starts();
  if (found.empty())
    throw NoPeriodicMotion("no periodic solution was found from " + std::to_string(highest * starts_of(options)) +
                           " initial states around the given one; increase --starts, or give an initial "
                           "state closer to a solution");
  for (PeriodicSolution &solution : found)
    solution.share /= highest * free_starts(options);
  return found;
}

} // namespace

const PeriodicMethod &minimising_method()
{
  static const Minimising method;
  return method;
}

} // namespace gestell::coupling

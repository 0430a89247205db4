#include "coupling/periodic/minimising.h"

#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting.h"
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

constexpr double box_reach     = 5.;   ///< of the box, in the largest excursions of the motion that the guess leads to
constexpr double same_orbit    = 1e-6; ///< distance of two motions, of their size, within which they are one
constexpr int    highest_ratio = 3;    ///< of sub-harmonic motions that are looked for
constexpr int    most_steps    = 60;   ///< of one minimisation
constexpr double astray        = 4.;   ///< distance from the middle of the box, in its size, at which a start is lost
constexpr double promising     = 0.01; ///< closing error below which Newton's method takes over
constexpr double coarse        = 1e-6; ///< tolerance of the steps far from a solution

/// r of (5.5.4/2) for Eigen's minimiser.
class LeastSquares : public Eigen::DenseFunctor<double>
{
public:
  /// Motions farther than `far` from `middle` are not looked at.
  LeastSquares(ShootingEquations &equations, const VectorXd &middle, double far)
      : Eigen::DenseFunctor<double>(int(middle.size()), int(middle.size())), equations_(equations), middle_(middle),
        far_(far)
  {
  }
  int operator()(const VectorXd &z, VectorXd &r) const
  {
    if (!evaluate(z, false))
      return -1;
    r = equations_.residual();
    return 0;
  }
  int df(const VectorXd &z, Eigen::MatrixXd &J) const
  {
    if (!evaluate(z, true))
      return -1;
    J = equations_.jacobian();
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
  constexpr int samples = 64;
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
    return "Least squares of (5.5.4/2) from many starts in a box: all solutions that are found, each once, with the "
           "share of the starts that led there.";
  }
  std::string refuses(const PeriodicProblem &problem) const override
  {
    return why_not_propagated(*problem.system, "settling");
  }
  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override;

private:
  static void search(const PeriodicProblem &problem, const Box &box, const PeriodicOptions &options,
                     std::vector<PeriodicSolution> &found);
  static bool known(const PeriodicProblem &problem, const PeriodicSolution &solution,
                    std::vector<PeriodicSolution> &found);
};

/// Whether a solution is one of those, begun in another period of the excitation, which then counts one start more.
bool Minimising::known(const PeriodicProblem &problem, const PeriodicSolution &solution,
                       std::vector<PeriodicSolution> &found)
{
  const double omega = 2. * M_PI / (problem.period / problem.ratio);
  const auto   apart = [&](const PeriodicSolution &a, const VectorXd &q, const VectorXd &v)
  { return std::sqrt(omega * omega * (a.q - q).squaredNorm() + (a.v - v).squaredNorm()); };
  std::vector<std::pair<VectorXd, VectorXd>> phases; // of the solution, at the begins of all periods
  trace(problem, solution, problem.ratio,
        [&](const OrbitPoint &point)
        {
          const double gone = std::round((point.t - problem.begin) / problem.period * problem.ratio);
          phases.emplace_back(point.q - gone / problem.ratio * problem.turn, point.v);
        });
  for (PeriodicSolution &other : found)
    for (const auto &phase : phases)
    {
      const double size = std::sqrt(omega * omega * other.q.squaredNorm() + other.v.squaredNorm());
      if (apart(other, phase.first, phase.second) <= same_orbit * std::max(size, 1e-300))
      {
        other.share += 1.;
        return true;
      }
    }
  return false;
}

void Minimising::search(const PeriodicProblem &problem, const Box &box, const PeriodicOptions &options,
                        std::vector<PeriodicSolution> &found)
{
  MethodOptions far_from = options.integration;
  far_from.tolerance     = std::max(far_from.tolerance, coarse);
  ShootingEquations equations(problem, options.integration), roughly(problem, far_from);
  PeriodicOptions   newton = options;
  newton.iterations        = 15;
  const VectorXd middle    = equations.unknowns(box.q, box.v, problem.period);
  const double   far       = astray * equations.unknowns(box.q_half, box.v_half, problem.period).norm();
  for (int k = 1; k <= options.starts && !problem.interrupted(); ++k)
    try
    {
      PeriodicGuess at{box.at(k, 0, box.q, box.q_half), box.at(k, box.q.size(), box.v, box.v_half), problem.period};
      if (k % 2 == 0)
        lead_in(roughly.flow(), problem, options, at);
      VectorXd                                z = equations.unknowns(at.q, at.v, at.period);
      LeastSquares                            squares(roughly, middle, far);
      Eigen::LevenbergMarquardt<LeastSquares> minimiser(squares);
      minimiser.setMaxfev(most_steps);
      minimiser.minimize(z);
      if (!(roughly.closing() < promising))
        continue;
      PeriodicSolution solution = shoot(equations, problem, z, newton);
      solution.method           = "minimise";
      solution.share            = 1.;
      if (!known(problem, solution, found))
        found.push_back(solution);
    }
    catch (const std::runtime_error &)
    {
      // a start that leads nowhere
    }
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
  const int                     highest = problem.period_is_unknown() || problem.ratio > 1 ? 1 : highest_ratio;
  for (int ratio = 1; ratio <= highest; ++ratio)
  {
    PeriodicProblem longer = problem;
    longer.period *= ratio;
    longer.turn *= ratio;
    longer.ratio *= ratio;
    search(longer, box, options, found);
  }
  if (found.empty())
    throw NoPeriodicMotion(
        "no periodic motion was found from " + std::to_string(highest * options.starts) +
        " starts in the box about the start; give --starts a larger number, or a start nearer to it");
  for (PeriodicSolution &solution : found)
    solution.share /= highest * options.starts;
  return found;
}

} // namespace

const PeriodicMethod &minimising_method()
{
  static const Minimising method;
  return method;
}

} // namespace gestell::coupling

#include "coupling/periodic/shooting_method.h"

#include "coupling/periodic/settling.h"
#include "coupling/periodic/shooting.h"

namespace gestell::coupling
{

namespace
{

class Shooting final : public PeriodicMethod
{
public:
  std::string name() const override { return "shooting"; }
  std::string meaning() const override
  {
    return "Newton's method on q(T) - q(0), q'(T) - q'(0) (5.5.4/1), its matrix by tangents that ride with the "
           "integrator, through events by saltation.";
  }
  std::string refuses(const PeriodicProblem &problem) const override
  {
    return why_not_propagated(*problem.system, "settling");
  }

  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override
  {
    ShootingEquations equations(problem, options.integration);
    PeriodicGuess     near = guess;
    lead_in(equations.flow(), problem, options, near);
    return {shoot(equations, problem, equations.unknowns(near.q, near.v, near.period), options)};
  }
};

} // namespace

const PeriodicMethod &shooting_method()
{
  static const Shooting method;
  return method;
}

} // namespace gestell::coupling

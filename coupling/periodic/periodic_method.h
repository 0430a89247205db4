#pragma once

#include "coupling/periodic/periodic_problem.h"
#include "coupling/periodic/periodic_solution.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// A motion near which a search begins.
struct PeriodicGuess
{
  Eigen::VectorXd q, v;        ///< at t_0 [n]
  double          period = 0.; ///< [s] where it is unknown; 0: that of the problem
};

/**
 * A way to periodic motions, as periodic_methods() lists it.
 *
 * It sees a second-order system and what is to repeat, and returns what it found, with Floquet multipliers where it
 * knows them.
 */
class PeriodicMethod
{
public:
  virtual ~PeriodicMethod() = default;

  virtual std::string name() const    = 0; ///< --method
  virtual std::string meaning() const = 0; ///< a sentence, with the source of its formulas

  /// Why it cannot treat this problem, and what serves instead; empty: it can.
  virtual std::string refuses(const PeriodicProblem &problem) const = 0;

  /// Solutions near the guess, or of a whole box of starts; each once.
  /// @throws NoPeriodicMotion, ConvergenceFailure
  virtual std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                              const PeriodicOptions &options) const = 0;
};

} // namespace gestell::coupling

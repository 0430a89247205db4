#pragma once

#include "coupling/periodic/periodic_problem.h"
#include "coupling/periodic/periodic_solution.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Initial guess of a search.
struct PeriodicGuess
{
  Eigen::VectorXd q, v;        ///< at t_0 [n]
  double          period = 0.; ///< [s] where it is unknown; 0: that of the problem
};

/// An option of single methods, --NAME of the command line and NAME of Python and of verification cases.
struct PeriodicOption
{
  std::string name, meaning;
  double      least = 0., most = 0.;
  bool        whole   = true;
  bool        of_lead = false; ///< of the way to the motion: a check, which begins at the motion, does not take it
};

/**
 * A method for periodic motions, as periodic_methods() lists it.
 *
 * It gets a second-order system and the periodicity condition, and returns solutions, with Floquet multipliers if
 * available.
 */
class PeriodicMethod
{
public:
  virtual ~PeriodicMethod() = default;

  virtual std::string name() const    = 0; ///< --method
  virtual std::string meaning() const = 0; ///< a sentence, with the source of its formulas

  /// Why it cannot treat this problem, and an alternative; empty: it can.
  virtual std::string refuses(const PeriodicProblem &problem) const = 0;

  /// Its options in addition to the common ones.
  virtual std::vector<PeriodicOption> options() const { return {}; }
  /// It integrates the motion itself, so that its failure is a property of the motion.
  virtual bool integrates() const = 0;
  /// It searches for all solutions.
  virtual bool finds_all() const { return false; }

  /// Solutions near the guess, or of a whole box of starts; each once.
  /// @throws NoPeriodicMotion, ConvergenceFailure
  virtual std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                              const PeriodicOptions &options) const = 0;
};

} // namespace gestell::coupling

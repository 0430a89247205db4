#pragma once

#include "coupling/integration/system/convergence_failure.h"
#include "coupling/integration/system/second_order_system.h"

#include <string>

namespace gestell::coupling
{

/// An element whose law gives no finite value for a motion, so that no step is possible.
struct LawWithoutValue
{
  std::string element; ///< its name in the scene; empty: there is none
  std::string words;   ///< where it has no value or an infinite slope, and the remedy
};

/// The first such element.
/// @param state  t, u, u', u''; p of sticking measures
LawWithoutValue law_without_value(const SecondOrderSystem &system, const LocalState &state);

/// Larger values do not occur in machines, and powers of them overflow: a motion or an iteration has diverged.
constexpr double beyond_machines = 1e100;

/// The same; none if the motion itself has diverged.
LawWithoutValue law_at_fault(const SecondOrderSystem &system, const LocalState &state);
/// Kind of failure
constexpr const char *without_value = "law-without-value";
/// @throws ConvergenceFailure with this text if there is such an element
void require_law_values(const SecondOrderSystem &system, const LocalState &state);

/// Calls a function that throws a ConvergenceFailure, and adds the text about a law to it.
template <class Fail>
void fail_with_law(const SecondOrderSystem &system, const LocalState &state, const Fail &fail)
{
  try
  {
    fail();
  }
  catch (const ConvergenceFailure &failure)
  {
    const LawWithoutValue law = law_at_fault(system, state);
    if (law.words.empty())
      throw;
    throw ConvergenceFailure(failure.what() + ("; " + law.words), without_value, law.element);
  }
}

} // namespace gestell::coupling

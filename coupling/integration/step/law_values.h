#pragma once

#include "coupling/integration/system/convergence_failure.h"
#include "coupling/integration/system/second_order_system.h"

#include <string>

namespace gestell::coupling
{

/// An element whose law gives no finite number at a motion, where no step can be made.
struct LawWithoutValue
{
  std::string element; ///< by its name in the scene; empty: there is none
  std::string words;   ///< where it has no value or an infinite slope, and the way out
};

/// The first such element.
/// @param state  t, u, u', u''; p of measures that stick
LawWithoutValue law_without_value(const SecondOrderSystem &system, const LocalState &state);

/// No machine gets there, and powers of it overflow: a motion or an iteration that has run away.
constexpr double beyond_machines = 1e100;

/// The same; none where the motion itself has run away.
LawWithoutValue law_at_fault(const SecondOrderSystem &system, const LocalState &state);
/// Kind of failure
constexpr const char *without_value = "law-without-value";
/// @throws ConvergenceFailure with them if there are any
void require_law_values(const SecondOrderSystem &system, const LocalState &state);

/// Calls what throws a ConvergenceFailure, and adds the words of a law to it.
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

#pragma once

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

/// Its words; "" where there is none, or where the motion itself has run away.
std::string law_words(const SecondOrderSystem &system, const LocalState &state);
/// @throws ConvergenceFailure with them if there are any
void require_law_values(const SecondOrderSystem &system, const LocalState &state);

} // namespace gestell::coupling

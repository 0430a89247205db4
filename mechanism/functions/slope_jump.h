#pragma once

#include "mechanism/functions/position_function.h"

#include <optional>
#include <string>

namespace gestell::mechanism
{

/// Where a function or its slope jumps: what an ideal joint cannot follow, as masses would have to jump with it.
struct SlopeJump
{
  std::string kink;          ///< "if_1_rises", as events are called
  std::string what;          ///< "the value" or "the slope"
  double      before, after; ///< of that
  double      x = 0.;        ///< where
};

/// Whether two values differ by more than what rounded constants in formulas make: 1e-6 in SI units, and 1e-5 of them.
bool differ(double before, double after);

/// The first jump in [from, to], which is walked in 1000 steps with the kinks in them located.
std::optional<SlopeJump> first_jump(const PositionFunction &f, double from, double to);

} // namespace gestell::mechanism

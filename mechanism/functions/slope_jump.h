#pragma once

#include "mechanism/functions/position_function.h"

#include <optional>
#include <string>

namespace gestell::mechanism
{

/// A jump of a function or its slope, which an ideal joint cannot follow because masses would have to jump too.
struct SlopeJump
{
  std::string kink;          ///< name of its event, "if_1_rises"
  std::string what;          ///< "the value" or "the slope"
  double      before, after; ///< value or slope on both sides
  double      x = 0.;        ///< position
};

/// Whether two values differ by more than the rounding of constants in formulas: 1e-6 in SI units plus a share of 1e-5.
bool differ(double before, double after);

/// The first jump in [from, to], searched in 1000 steps, with the kinks in them located.
std::optional<SlopeJump> first_jump(const PositionFunction &f, double from, double to);

} // namespace gestell::mechanism

#pragma once

#include "fem/values/number_text.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

/// @throws std::invalid_argument for a buckling factor of 1 or less.
inline void require_below_buckling(double lambda, const std::string &place)
{
  if (!(lambda > 1.))
    throw std::invalid_argument((place.empty() ? "prestress" : place) +
                                ": prestress beyond buckling: the frame buckles at " + rounded(lambda) +
                                " times these loads; reduce them or their 'factor', or stiffen the frame");
}

/// @param where  "", or " with the interfaces fixed".
inline std::string buckling_statement(double lambda, const std::string &where)
{
  return std::isinf(lambda) ? "prestress: tension dominates, and the frame does not buckle" + where
                            : "prestress: the buckling factor is " + rounded(lambda) + where;
}

} // namespace gestell::coupling

#pragma once

#include "fem/values/frame_matrices.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace gestell::coupling
{

enum class BucklingValue
{
  exact,
  upper_bound
};

/// @throws std::invalid_argument for a buckling factor of 1 or less.
inline void require_below_buckling(double lambda, const std::string &place, BucklingValue value = BucklingValue::exact)
{
  if (!(lambda > 1.))
    throw std::invalid_argument((place.empty() ? "prestress" : place) +
                                ": prestress beyond buckling: the frame buckles at " + rounded(lambda) +
                                " times these loads" + (value == BucklingValue::upper_bound ? " or less" : "") +
                                ", and needs more than 1; reduce them or their 'factor', or stiffen the frame");
}

/// Adds a buckling factor, infinite if tension dominates: a statement, and the least of them as a fact.
/// @param where  "", or " with the interfaces fixed".
inline void add_buckling(double lambda, BucklingValue value, const std::string &where,
                         std::vector<std::string> &statements, fem::FrameFacts &facts)
{
  statements.push_back(std::isinf(lambda)
                           ? "prestress: tension dominates, and the frame does not buckle" + where
                           : std::string("prestress: the buckling factor is ") +
                                 (value == BucklingValue::upper_bound ? "at most " : "") + rounded(lambda) + where);
  facts.buckling_factor = std::min(facts.buckling_factor.value_or(lambda), lambda);
}

} // namespace gestell::coupling

#pragma once

#include "apps/scene/language/quantity.h"
#include "apps/study/values/study_table.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A value of the study that is to be in the unit of an output: a limit, or the scale of a goal.
struct OutputValue
{
  int         output = 0;
  Quantity    value{};
  std::string place{}; ///< with the key, as messages begin
};

/// A goal of a sum.
struct SummedGoal
{
  int         output    = 0;
  bool        is_scaled = false;
  std::string place{};
};

/// What a study says of its outputs before their units are known.
struct OutputClaims
{
  std::vector<OutputValue>             values{};
  std::vector<std::vector<SummedGoal>> sums{};
};

/**
 * Compares it with the units that the first run tells.  Plain numbers are in SI.
 * @throws std::invalid_argument with the place: a value in another unit, a sum of goals in different units of which one
 * has no scale
 */
void check_units(const OutputClaims &claims, const std::vector<StudyOutput> &outputs);

} // namespace gestell::apps

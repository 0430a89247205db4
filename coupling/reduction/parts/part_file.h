#pragma once

#include "coupling/reduction/parts/condensed_part.h"

#include <string>

namespace gestell::coupling
{

/// Number of modes to retain of a part: all below a frequency, and the lowest of them at least.
struct PartModes
{
  int    least = 0;
  double hertz = 0.; ///< 0: the least number
};

/**
 * Condenses a part and stores it: in the cache of frames under the key of its matrices, interface and modes, or in
 * `folder` if the cache cannot be written.  A part that is in the cache is not condensed again.
 *
 * @param place   of the frame, for the list of the cache.
 * @param folder  of this run.
 * @return        the file.
 * @throws as condense(); std::runtime_error if neither folder can be written.
 */
std::string stored_part(PartOfFrame part, const PartModes &modes, const std::string &place, const std::string &folder);

/// What is read of a part; omega and sigma always.
enum class PartContent
{
  frequencies,
  modes, ///< V
  sums   ///< all but V
};

/// @throws std::runtime_error with the defect of the file.
CondensedPart read_part(const std::string &file, PartContent content);

} // namespace gestell::coupling

#pragma once

#include "coupling/reduction/methods/reduction_entry.h"

namespace gestell::coupling
{

/**
 * Static shapes of the interface and modes of the frame as supported, its interface free, whose frequencies the reduced
 * model has exactly.  Together they span all of MacNeal's and Rubin's space: see free_modes().
 *
 * Source: Rubin, AIAA Journal 13(8), 1975, 995-1006; docs/theory/reduction.md.
 */
struct FreeInterface
{
  static ReductionEntry entry()
  {
    return {"free-interface",
            "static shapes of the interface and modes of the frame as it is supported",
            {"modes", "frequency", "eigensolver", "inertia_relief"}};
  }
  static BasisFunction basis;
};

} // namespace gestell::coupling

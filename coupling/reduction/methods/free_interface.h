#pragma once

#include "coupling/reduction/methods/reduction_entry.h"

namespace gestell::coupling
{

/**
 * Constraint modes and modes of the supported frame with free interface, whose frequencies are exact in the reduced
 * model. They span the space of MacNeal and Rubin: see free_modes().
 *
 * Source: Rubin, AIAA Journal 13(8), 1975, 995-1006; docs/theory/reduction.md.
 */
struct FreeInterface
{
  static ReductionEntry entry()
  {
    return {"free-interface",
            "static shapes of the interface and modes of the frame as it is supported",
            {"modes", "frequency", "factor", "eigensolver", "inertia_relief"}};
  }
  static BasisFunction basis;
};

} // namespace gestell::coupling

#pragma once

#include "coupling/reduction/methods/reduction_entry.h"

namespace gestell::coupling
{

/**
 * Fixed-interface reduction of a linear frame (Craig-Bampton; Kaltofen, 5.5.3/14-23).
 *
 *     q = [ q1 ]  =  T p,     T = [     E          0  ]
 *         [ q2 ]                  [ -C22^-1 C21   V22 ]
 *
 * q1, the coordinates of all interfaces, remains physical, so that mechanisms can be attached to it directly; the
 * deflection under static interface loads is exact for any number of modes.  One factor of C22 is used.
 *
 * Automatic number of modes (options.n_modes < 0): see select_modes().  Completeness is verified by inertia, see
 * SturmCheckedModes.
 *
 * Source: Craig & Bampton, AIAA Journal 6(7), 1968, 1313-1319; docs/theory/reduction.md.
 */
struct CraigBampton
{
  static ReductionEntry entry()
  {
    return {"craig-bampton",
            "static shapes of the interface and fixed-interface modes",
            {"tolerance", "modes", "frequency", "inside", "factor", "eigensolver", "inertia_relief"}};
  }
  static BasisFunction basis;
};

} // namespace gestell::coupling

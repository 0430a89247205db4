#pragma once

#include "coupling/reduction/methods/reduction_entry.h"

namespace gestell::coupling
{

/**
 * Static condensation: the static shapes of the interface alone,
 *
 *     q = [ q1 ]  =  T q1,     T = [     E        ]
 *         [ q2 ]                   [ -C22^-1 C21  ]
 *
 * Statics under loads on the interface are exact, internal inertia follows the static shapes; frequencies are upper
 * bounds. Fixed-interface modes are omitted, and counted by inertia up to the frequency of interest. With
 * options.frequency = 0 the limit of validity is the highest frequency with an estimated error within
 * options.tolerance.
 *
 * Source: Guyan, AIAA Journal 3(2), 1965, 380; docs/theory/reduction.md (22).
 */
struct Guyan
{
  static ReductionEntry entry()
  {
    return {"guyan", "static shapes of the interface, no modes", {"tolerance", "frequency", "factor", "inertia_relief"}};
  }
  static BasisFunction basis;
};

} // namespace gestell::coupling

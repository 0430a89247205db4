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
 * Statics under loads on the interface are exact, inertia of the inside follows them; frequencies come from above.
 * Modes that the frame has with its interface held are left out, and counted by inertia up to the frequency of
 * interest.
 *
 * options.frequency of zero: the model is meant to hold as far as the estimated error of its frequencies stays within
 * options.tolerance.
 *
 * Source: Guyan, AIAA Journal 3(2), 1965, 380; docs/theory/reduction.md (22).
 */
struct Guyan
{
  static ReductionEntry entry()
  {
    return {"guyan", "static shapes of the interface, no modes", {"tolerance", "frequency", "inertia_relief"}};
  }
  static BasisFunction basis;
};

} // namespace gestell::coupling

#pragma once

#include "coupling/reduction/methods/reduction_entry.h"

namespace gestell::coupling
{

/**
 * Modes of the whole machine, frame and mechanism, in place of all coordinates,
 *
 *     p'' + 2 delta p' + omega^2 p = V^T (f_t + f_nl(V p, V p', V p'')),     q = V p,
 *
 * chosen by superpose() when the machine has been built: there is no reduced frame.
 *
 * Source: (5.5.3/8 to 13); docs/theory/reduction.md.
 */
struct ModalSuperposition
{
  static ReductionEntry entry()
  {
    return {"modal",
            "modes of frame and mechanism together in place of their coordinates",
            {"modes", "frequency", "tolerance", "damping"},
            ReductionEntry::Makes::modes_of_machine};
  }
  static constexpr BasisFunction *basis = nullptr;
};

} // namespace gestell::coupling

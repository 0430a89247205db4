#pragma once

#include "coupling/reduction/methods/craig_bampton.h"

namespace gestell::coupling
{

/**
 * All DOFs retained, T = E, with two names: a machine uses the matrices unchanged, dense if small, else sparse.  Then
 * each step is condensed to the coordinates with forces of the mechanism,
 *
 *     A_LL q_L = b_L - A_LN q_N,     (A_NN - A_NL A_LL^-1 A_LN) q_N = b_N - A_NL A_LL^-1 b_L,     A = M + h B + h^2 C,
 *
 * with one sparse factor for each step size, stored for all step sizes: only q_N is in Newton's method. The keys belong
 * to the reduced companion of large frames.
 *
 * Source: (5.5.3/1 to 7); docs/theory/integration.md (8) to (10).
 */
template <typename Name>
struct EveryCoordinate
{
  static ReductionEntry entry()
  {
    return {Name::name, Name::title, CraigBampton::entry().keys, ReductionEntry::Makes::no_frame};
  }
  static constexpr BasisFunction *basis = nullptr;
};

struct CondensationName
{
  static constexpr auto name = "condensation";
  static constexpr auto title =
      "every coordinate kept, each step condensed to those that forces of the mechanism act on";
};
struct UnreducedName
{
  static constexpr auto name  = "none";
  static constexpr auto title = "every coordinate kept";
};

using Condensation = EveryCoordinate<CondensationName>;
using Unreduced    = EveryCoordinate<UnreducedName>;

} // namespace gestell::coupling

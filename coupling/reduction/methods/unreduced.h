#pragma once

#include "coupling/reduction/methods/craig_bampton.h"

namespace gestell::coupling
{

/// Every coordinate kept, T = E: a machine takes the matrices as they are, dense if they are few.  The keys are of the
/// reduced companion that large frames start from.
struct Unreduced
{
  static ReductionEntry           entry() { return {"none", "every coordinate kept", CraigBampton::entry().keys}; }
  static constexpr BasisFunction *basis = nullptr;
};

} // namespace gestell::coupling

#include "coupling/reduction/methods/free_interface.h"

#include "coupling/reduction/methods/reduction_space.h"
#include "coupling/reduction/shapes/free_interface_modes.h"
#include "coupling/reduction/shapes/interface_statics.h"

#include <utility>

namespace gestell::coupling
{

ReductionSpace FreeInterface::basis(const fem::FrameMatrices &frame, const ReductionOptions &options,
                                    InterfaceStatics &statics)
{
  statics.begin("modes with the interface free");
  FreeModes      free = free_modes(statics.basis, statics.held, frame, options);
  ReductionSpace space{std::move(statics.basis), std::move(free.W)};
  space.refined.n_rigid = free.n_rigid;
  space.exact           = std::move(free.omega);
  if (!free.statement.empty())
    space.statements.push_back(free.statement);
  return space;
}

} // namespace gestell::coupling

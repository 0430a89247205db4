#pragma once

#include "coupling/reduction/methods/condensation.h"
#include "coupling/reduction/methods/craig_bampton.h"
#include "coupling/reduction/methods/free_interface.h"
#include "coupling/reduction/methods/guyan.h"
#include "coupling/reduction/methods/modal_superposition.h"

namespace gestell::coupling
{

/// The names are in the core part, the work in the FEM part: only reduce_frame() uses `basis`.
template <typename... Methods>
struct ReductionTable
{
  static std::vector<ReductionEntry> entries() { return {Methods::entry()...}; }

  /// Null without a reduction, or for an unknown name.
  static BasisFunction *basis(const std::string &name)
  {
    BasisFunction *found = nullptr;
    ((Methods::entry().name == name ? void(found = Methods::basis) : void()), ...);
    return found;
  }
};

/// All reductions, a line each.
using Reductions = ReductionTable<CraigBampton,  //
                                  FreeInterface, //
                                  Guyan,         //
                                  ModalSuperposition,
                                  Condensation, //
                                  Unreduced>;

} // namespace gestell::coupling

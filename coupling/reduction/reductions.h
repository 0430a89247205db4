#pragma once

#include "coupling/reduction/methods/condensation.h"
#include "coupling/reduction/methods/craig_bampton.h"
#include "coupling/reduction/methods/free_interface.h"
#include "coupling/reduction/methods/guyan.h"
#include "coupling/reduction/methods/modal_superposition.h"

namespace gestell::coupling
{

/// The names are of the light half, the work is of the heavy one: only reduce_frame() asks for `basis`.
template <typename... Methods>
struct ReductionTable
{
  static std::vector<ReductionEntry> entries() { return {Methods::entry()...}; }

  /// Null where nothing is to be made, or nothing is called so.
  static BasisFunction *basis(const std::string &name)
  {
    BasisFunction *found = nullptr;
    ((Methods::entry().name == name ? void(found = Methods::basis) : void()), ...);
    return found;
  }
};

/// All there are: a line each.
using Reductions = ReductionTable<CraigBampton,  //
                                  FreeInterface, //
                                  Guyan,         //
                                  ModalSuperposition,
                                  Condensation, //
                                  Unreduced>;

} // namespace gestell::coupling

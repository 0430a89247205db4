#pragma once

#include <TopoDS_Shape.hxx>

namespace gestell::fem
{

/// A copy of all shapes of the model that is open in gmsh, in its unit, for what gmsh cannot compute.  gmsh hands
/// shapes out through a file only: one in a passing folder.
TopoDS_Shape occ_snapshot();

} // namespace gestell::fem

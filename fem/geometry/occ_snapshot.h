#pragma once

#include <TopoDS_Shape.hxx>

namespace gestell::fem
{

/// A copy of all shapes of the model open in gmsh, in its unit, for computations by OpenCASCADE. gmsh exports shapes
/// through a (temporary) file only.
TopoDS_Shape occ_snapshot();

} // namespace gestell::fem

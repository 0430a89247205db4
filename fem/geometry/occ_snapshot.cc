#include "fem/geometry/occ_snapshot.h"

#include "fem/values/temporary_directory.h"

#include <gmsh.h>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>

#include <stdexcept>
#include <string>

namespace gestell::fem
{

TopoDS_Shape occ_snapshot()
{
  const TemporaryDirectory folder;
  const std::string        file = folder.path() / "shapes.brep";
  gmsh::write(file);
  TopoDS_Shape shape;
  if (!BRepTools::Read(shape, file.c_str(), BRep_Builder()))
    throw std::runtime_error("exchanging shapes with OpenCASCADE failed through " + file);
  return shape;
}

} // namespace gestell::fem

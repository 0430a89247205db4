#include "fem/mesh/gmsh_child.h"

#include "fem/geometry/cad_file.h"
#include "fem/mesh/memory_estimate.h"

namespace gestell::fem
{

ChildTask gmsh_task(const CadSource &source, const std::string &phase)
{
  const auto kind     = kind_of_file(source.path);
  const bool programs = kind == CadFile::geo || kind == CadFile::abaqus; // one draws, both name other files
  return {source.path, source.place + ": " + source.path, phase,
          reading_limits(source.path, programs ? FileContent::program : FileContent::geometry, available_memory()),
          !in_one_process()};
}

} // namespace gestell::fem

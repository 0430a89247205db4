#include "fem/mesh/gmsh_child.h"

#include "fem/geometry/cad_file.h"
#include "fem/mesh/memory_estimate.h"
#include "fem/values/message_text.h"

#include <algorithm>
#include <cmath>

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

std::vector<MeshAttempt> mesh_attempts(const FrameSpecification &specification)
{
  std::vector<MeshAttempt> attempts  = {{specification, WallSizes::where_needed, ""}};
  constexpr int            n_smaller = 3; // sizes: the last gives up to 38 times as many cells
  const double             size      = specification.mesh.size;
  for (int k = 0; k <= (size > 0. ? n_smaller : 0); ++k) // 0: chosen by the mesher
  {
    MeshAttempt  attempt{specification, WallSizes::everywhere, ""};
    MeshOptions &mesh = attempt.specification.mesh;
    mesh.size *= std::pow(2. / 3., k);
    for (auto &[surface, of_surface] : mesh.surface_size)
      of_surface = std::min(of_surface, mesh.size);
    attempt.text = (size > 0. ? "size = " + text(1e3 * mesh.size) + " mm and " : "") +
                   std::string("curved faces sized by the thickness of their walls");
    attempts.push_back(attempt);
  }
  return attempts;
}

std::string note_of(const MeshAttempt &attempt, const std::string &first_failure)
{
  return attempt.specification.mesh.place + ": meshed with " + attempt.text +
         ", because the given size fails: " + first_failure;
}

} // namespace gestell::fem

#pragma once

#include <string>

namespace gestell::fem
{

/// Phases of gmsh's work for a frame in a child process, as reported by progress.
namespace mesh_phase
{
constexpr const char *reading = "reading CAD", *plates = "sweeping plates", *surfaces = "meshing surfaces",
                     *volumes = "meshing volumes";
}

/// Whether gmsh is running, so that progress may throw: the child is then ended, and no other work is affected.
inline bool may_be_stopped(const std::string &phase)
{
  for (const std::string name : {mesh_phase::reading, mesh_phase::plates, mesh_phase::surfaces, mesh_phase::volumes})
    if (phase.size() >= name.size() && phase.compare(phase.size() - name.size(), name.size(), name) == 0)
      return true; // for several meshes the phase begins with the number
  return false;
}

} // namespace gestell::fem

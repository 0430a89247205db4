#pragma once

#include <string>

namespace gestell::fem
{

/// Phases in which gmsh works for a frame in a child process, as progress tells them.
namespace mesh_phase
{
constexpr const char *reading = "reading CAD", *plates = "sweeping plates", *surfaces = "meshing surfaces",
                     *volumes = "meshing volumes";
}

/// Whether gmsh is at work, so that progress may throw: the child is ended then, and nothing else is under way.
inline bool may_be_stopped(const std::string &phase)
{
  for (const std::string name : {mesh_phase::reading, mesh_phase::plates, mesh_phase::surfaces, mesh_phase::volumes})
    if (phase.size() >= name.size() && phase.compare(phase.size() - name.size(), name.size(), name) == 0)
      return true; // one of several meshes has its number before
  return false;
}

} // namespace gestell::fem

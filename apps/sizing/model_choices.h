#pragma once

#include "apps/scene/scene.h"

#include <map>
#include <string>

namespace gestell::apps
{

/// Whether the program makes the mesh of the scene's frame, so that its size can be chosen.
bool mesh_is_made(const Scene &scene);
/// The same for a frame of parts: whether it makes the meshes of all parts.
bool meshes_of_parts_are_made(const Scene &scene);
/// Whether either of them is true.
bool mesh_can_change(const Scene &scene);

/// Geometry error at curved faces caused by the sides of the elements.
enum class Sides ///< in the order of increasing error
{
  exact,    ///< none: sides follow the faces, or all faces are planes
  straight, ///< tetrahedra with straight sides, which could be curved
  unknown   ///< hexahedra, and meshes from files
};
/// For each geometry file, whether all its faces are planes.
using KnownPlanes = std::map<std::string, bool>;
/// @param known  cache of what was read from the files
Sides sides_of(const Scene &scene, KnownPlanes &known);

/// Whether the frame of the scene is reduced with a number of modes that can be chosen.
bool modes_are_chosen(const Scene &scene);

} // namespace gestell::apps

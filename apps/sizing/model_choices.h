#pragma once

#include "apps/scene/scene.h"

#include <map>
#include <string>

namespace gestell::apps
{

/// Whether the mesh of the scene's frame is made by the program, so that its size can be chosen.
bool mesh_is_made(const Scene &scene);
/// The same of a frame of parts: of all of them.
bool meshes_of_parts_are_made(const Scene &scene);
/// Either of them.
bool mesh_can_change(const Scene &scene);

/// What the sides of its cells leave of curved faces.
enum class Sides ///< the worse the later
{
  exact,    ///< nothing: they follow the faces, or there are but planes
  straight, ///< of tetrahedra, which could follow them
  unknown   ///< of hexahedra, and of meshes from files
};
/// Of a geometry's file: whether its faces are planes alone.
using KnownPlanes = std::map<std::string, bool>;
/// @param known  where what the files tell is kept
Sides sides_of(const Scene &scene, KnownPlanes &known);

/// Whether the frame of the scene is reduced, so that its number of modes can be chosen.
bool modes_are_chosen(const Scene &scene);

} // namespace gestell::apps

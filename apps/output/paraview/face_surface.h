#pragma once

#include "coupling/plugin/mesh_report.h"

#include <filesystem>
#include <string>

namespace gestell::apps
{

/**
 * Writes the outside of a frame for ParaView: by triangle `face` (its number), `colour`, `area [m^2]` of the face; as
 * field data the entries `selectors` of all faces for a scene, and `faces`, their numbers.
 *
 * @return a warning where this build cannot, else "".
 * @throws std::runtime_error if the file cannot be written.
 */
std::string write_face_surface(const std::filesystem::path &path, const coupling::MeshReport &report);

} // namespace gestell::apps

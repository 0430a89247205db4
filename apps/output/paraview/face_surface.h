#pragma once

#include "coupling/plugin/mesh_report.h"

#include <filesystem>
#include <string>

namespace gestell::apps
{

/**
 * Writes the surface of a frame for ParaView. Cell data of each triangle: `face` (its number), `colour`, `area [m^2]`
 * of the face. Field data: `selectors`, the scene key of every face, and `faces`, their numbers.
 *
 * @return a warning if this build cannot write it, else "".
 * @throws std::runtime_error if the file cannot be written.
 */
std::string write_face_surface(const std::filesystem::path &path, const coupling::MeshReport &report);

} // namespace gestell::apps

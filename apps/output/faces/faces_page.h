#pragma once

#include "coupling/plugin/mesh_report.h"

#include <string>

namespace gestell::apps
{

/**
 * faces.html: an interactive view of the frame, eight fixed views and a table of its faces.  For the selected face the
 * page shows kind, position and size, in the file's unit and in metres, and the scene key that selects it.  Needs no
 * network.
 *
 * @param file  as the user gave it
 */
std::string faces_page(const coupling::MeshReport &report, const std::string &file, const std::string &version);

/// The table [frame.surface.NAME] of a face with a name of its own, "face 12".
std::string face_entry(const coupling::SurfaceReport &surface);

} // namespace gestell::apps

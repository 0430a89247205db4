#pragma once

#include "coupling/plugin/mesh_report.h"

#include <string>

namespace gestell::apps
{

/**
 * faces.html: the frame to turn, to click and from eight sides, a table of its faces, and of the face that is chosen
 * kind, place and size, in the file's unit and in metres, and the entry that selects it in a scene.  Opens without a
 * network.
 *
 * @param file  as the user gave it
 */
std::string faces_page(const coupling::MeshReport &report, const std::string &file, const std::string &version);

/// The entry [frame.surface.NAME] of a face under a name of its own, "face 12".
std::string face_entry(const coupling::SurfaceReport &surface);

} // namespace gestell::apps

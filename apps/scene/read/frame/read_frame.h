#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Reads [frame], and [material.NAME] for it.
FrameRequest read_frame(const SceneTable &scene);

/// Reads [frame] of a frame made from CAD or a mesh.
fem::FrameSpecification read_frame_geometry(const SceneTable &frame, const SceneTable &scene);

/// Reads what `prestress` of all frames contains, and that of a frame of one part.
fem::Prestress read_prestress(const SceneTable &prestress, const SceneTable &scene);
fem::Prestress read_surface_loads(const SceneTable &prestress, const SceneTable &scene,
                                  const fem::FrameSpecification &frame);

/// Reads [frame] of several parts and their joints.
coupling::FrameOfParts read_frame_parts(const SceneTable &frame, const SceneTable &scene);

/// Keys of [frame] of several parts; of [frame.part.NAME], with those of a frame from geometry; of [frame.joint.NAME].
const std::vector<Key> &parts_frame_keys();
const std::vector<Key> &frame_part_keys();
const std::vector<Key> &frame_joint_keys();

/// Reads [frame] given by matrices; has_translations: whether `translations` were given or could be derived.
fem::FrameMatrices read_frame_matrices(const SceneTable &frame, bool &has_translations);

std::vector<std::string> interface_names(const FrameRequest &frame);

} // namespace gestell::apps

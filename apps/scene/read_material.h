#pragma once

#include "apps/scene/scene_table.h"
#include "fem/frame_specification.h"

namespace gestell::apps
{

/// `material` of a frame or a body: a table { E, nu, rho }, the name of a [material.NAME] of the scene, or of a
/// built-in one; steel if it is missing.
fem::Material read_material(const SceneTable &table, const SceneTable &scene);

} // namespace gestell::apps

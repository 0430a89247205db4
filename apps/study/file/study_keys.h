#pragma once

#include "apps/scene/file/declaration.h"

namespace gestell::apps
{

/// Keys of a study file, and of its tables.
const std::vector<Key> &study_keys();
const std::vector<Key> &study_scene_keys();
const std::vector<Key> &study_variable_keys();
const std::vector<Key> &study_design_keys();
const std::vector<Key> &study_surface_keys();
const std::vector<Key> &study_optimise_keys();
const std::vector<Key> &study_choose_keys();
const std::vector<Key> &study_goal_keys();
const std::vector<Key> &study_limit_keys();
const std::vector<Key> &study_robust_keys();

} // namespace gestell::apps

#pragma once

#include "apps/study/runs/scene_variants.h"

#include <filesystem>
#include <string>

namespace gestell::apps
{

/// A scene file that extends that of the study by its settings and by these levels of the variables; its path is
/// relative to `folder`, where it is meant to be.
std::string optimum_scene(const StudyFile &study, const SceneVariants &variants, const Eigen::VectorXd &levels,
                          const std::filesystem::path &folder);

} // namespace gestell::apps

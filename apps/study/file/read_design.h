#pragma once

#include "apps/study/designs/make_design.h"
#include "apps/study/file/study_file.h"

namespace gestell::apps
{

/// The points of a study, coded and as values of its variables.
struct StudyPoints
{
  Design          design{};
  Eigen::MatrixXd levels{}; ///< runs x variables; of a list as they are written
};

/// The points that [design] asks for.
/// @throws std::invalid_argument with file and line
StudyPoints read_design(const StudyFile &study);

} // namespace gestell::apps

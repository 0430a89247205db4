#pragma once

#include "apps/study/designs/make_design.h"
#include "apps/study/file/study_file.h"

namespace gestell::apps
{

/// The points that [design] asks for.
/// @throws std::invalid_argument with file and line
Design read_design(const StudyFile &study);

} // namespace gestell::apps

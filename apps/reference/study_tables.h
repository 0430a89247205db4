#pragma once

#include "apps/reference/declared_tables.h"

namespace gestell::apps
{

/// The tables of a study file: "study", "study.design".
const std::vector<DeclaredTable> &study_tables();

/// Tables of scenes, then of studies.
const std::vector<DeclaredTable> &told_tables();

} // namespace gestell::apps

#pragma once

#include "apps/analysis/analysis.h"
#include "apps/cli/command.h"

namespace gestell::apps
{

/// The command of an analysis: checks, holds the folder of results, computes, writes, prints what it found, warns.
Command analysis_command(const AnalysisEntry &entry);

} // namespace gestell::apps

#pragma once

#include "apps/cli/command.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// `gestell chart --reductions`: error against CPU time of the reductions of a scene's frame.
struct ReductionChart
{
  bool             requested = false, full = false;
  std::string      outputs; ///< empty: largest and smallest value of every signal
  std::vector<int> modes;   ///< empty: default
};

int chart_reductions(const CommonOptions &options, const ReductionChart &requested);

} // namespace gestell::apps

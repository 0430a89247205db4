#pragma once

#include "coupling/simulation/run_result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// The run of another scene beside this one.
struct ComparedRun
{
  std::string         scene; ///< its name
  coupling::RunResult run;
};

/// A signal that both runs have, by its number in each.
struct SharedSignal
{
  std::size_t a, b;
};

/// Signals of the same name and unit, in the order of the first run.
std::vector<SharedSignal> shared_signals(const coupling::RunResult &a, const coupling::RunResult &b);

} // namespace gestell::apps

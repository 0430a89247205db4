#pragma once

#include "coupling/simulation/run_result.h"

#include <string>

namespace gestell::apps
{

/// For people: "bdf of order 2, fixed step 1e-05 s, from 0 s to 0.7 s; events located, ...".
std::string settings_text(const coupling::RunOptions &run);

} // namespace gestell::apps

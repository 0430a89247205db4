#pragma once

#include "apps/output/values/result.h"

#include <string>

namespace gestell::apps
{

/// The machine to be turned and seen in motion, in its modes and under its stresses, as HTML with its data for the
/// script; empty where there is nothing to be seen.  `result` has the whole skin of the frame.
std::string machine_view(const Result &result);

} // namespace gestell::apps

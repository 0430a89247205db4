#pragma once

#include "apps/output/result.h"

namespace gestell::apps
{

/// A made-up machine with all that can be written: a frame with a skin (a box that shears and lifts), crank, rod and
/// slide, n rows of history with one shock, events, modes.
Result example_result(int n_rows = 1000);

} // namespace gestell::apps

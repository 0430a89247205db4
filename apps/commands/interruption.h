#pragma once

#include <atomic>

namespace gestell::apps
{

/// Becomes true when the user interrupts (SIGINT, SIGTERM); a second signal ends the program at once.
const std::atomic<bool> &interruption();

} // namespace gestell::apps

#pragma once

#include <atomic>

namespace gestell::apps
{

/// Becomes true when the user interrupts (SIGINT, SIGTERM); a further one, half a second later or more,
/// ends the program at once.
const std::atomic<bool> &interruption();

} // namespace gestell::apps

#pragma once

#include "coupling/frame/reduction_options.h"

#include <atomic>
#include <string>

namespace gestell::apps
{

/// Becomes true when the user interrupts (SIGINT, SIGTERM, SIGHUP); a second signal at least half a second later ends
/// the program at once.
const std::atomic<bool> &interruption();

/// Records what the process would leave behind if a signal ended it now: locks of folders and temporary files.
void note_what_is_left();

/// For commands that do not check interruption(): a signal ends the process with exit code 130 and removes its locks
/// and temporary files.
void end_where_nothing_is_saved();

/// Wraps `progress`: until a phase of this name begins, there is nothing to save, and an interruption ends the program
/// at once with exit code 130, even in the middle of a long computation.
coupling::Progress nothing_to_save_before(const std::string &phase, const coupling::Progress &progress);

} // namespace gestell::apps

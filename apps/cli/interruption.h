#pragma once

#include "coupling/frame/reduction_options.h"

#include <atomic>
#include <string>

namespace gestell::apps
{

/// Becomes true when the user interrupts (SIGINT, SIGTERM, SIGHUP); a further one, half a second later or more,
/// ends the program at once.
const std::atomic<bool> &interruption();

/// Notes what the process would leave behind if a signal ended it now: locks of folders and temporary files.
void note_what_is_left();

/// For commands that do not ask interruption(): a signal ends the process as exit code 130 says, and nothing is left
/// behind.
void end_where_nothing_is_saved();

/// What `progress` hears, until a phase of this name begins: before, there is nothing to save, and an interruption ends
/// the program at once, with exit code 130, however long what is under way would take.
coupling::Progress nothing_to_save_before(const std::string &phase, const coupling::Progress &progress);

} // namespace gestell::apps

#pragma once

#include <sys/types.h>

namespace gestell::fuzz
{

/// [byte] that a process which executes may take beyond what it has.
constexpr double most_memory = 1e9;

/// Holds this process to most_memory, and leaves no core file where it dies.
void hold_memory();

/// Of a process, not of its children [s].
double processor_seconds(pid_t process);

/// Standard output and error of this process go nowhere, and it dies with its parent.
void be_quiet_child();

} // namespace gestell::fuzz

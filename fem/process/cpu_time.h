#pragma once

namespace gestell::fem
{

/// [s] Time of processors, of programs and of the system for them, that this process and the children that it waited
/// for took so far.
double cpu_time();

} // namespace gestell::fem

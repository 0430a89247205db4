#pragma once

namespace gestell::fem
{

/// [s] CPU time, user and system, of this process and of its ended children.
double cpu_time();

} // namespace gestell::fem

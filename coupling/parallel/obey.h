#pragma once

namespace gestell::coupling
{

/// On ranks above 0: runs the task with this number, together with all others.
void obey(int order);

} // namespace gestell::coupling

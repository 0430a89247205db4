#pragma once

namespace gestell::coupling
{

/// Ranks above 0: the task of this order, with all others.
void obey(int order);

} // namespace gestell::coupling

#pragma once

#include <functional>

namespace gestell::apps
{

/// Calls task(0), ..., task(n - 1) by so many threads, each the next one that none has taken; one does it in this
/// thread, in order.  What a task throws first is thrown once all have ended; no further ones are begun then.
void side_by_side(int n, int threads, const std::function<void(int)> &task);

} // namespace gestell::apps

#pragma once

#include "fem/process/child.h"

#include <functional>

namespace gestell::fem
{

/**
 * Calls work(i, progress) for i = 0, ..., n - 1, `at_once` of them at a time, each in a thread of its own that waits
 * for a child (in_child()).  The calling thread alone calls `progress`, with the last phase reported and the completed
 * share of all.  One at a time needs no thread.
 *
 * @throws the first exception of `work` or `progress`; the others have ended then, as their own progress throws.
 */
void side_by_side(int n, int at_once, const ChildProgress &progress,
                  const std::function<void(int i, const ChildProgress &progress)> &work);

} // namespace gestell::fem

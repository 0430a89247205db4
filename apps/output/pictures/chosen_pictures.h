#pragma once

#include "apps/output/values/result.h"

#include <cstddef>
#include <vector>

namespace gestell::apps
{

/**
 * Indices of the saved states of a run that are shown, ascending: all, or at most `most` >= 3.
 *
 * Every k-th one is chosen (k need not be whole), so that pictures stay denser around events and the main peak as the
 * saved states are; the first, the last and the one at the main peak are included.
 */
std::vector<std::size_t> chosen_pictures(const Result &result, std::size_t most);

} // namespace gestell::apps

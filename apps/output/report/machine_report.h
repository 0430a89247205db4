#pragma once

#include "apps/output/values/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Pictures for a page with a view of the machine, see machine_picture().

/// The machine at the start of the run, where bodies move far in outline also at its end; without a run where its modes
/// are taken.
std::string machine_figure(const Result &result);

/// The deformed machine at the main peak of a run; empty where there is none.
std::string peak_figure(const Result &result);

/// The lowest modes of "coupled" machine or "frame", deformed.
std::string mode_pictures(const std::vector<coupling::Mode> &modes, const std::string &of, std::size_t most);

} // namespace gestell::apps

#pragma once

#include "apps/output/values/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Pictures for a page with a view of the machine, see machine_picture().

/// The machine at the start of the run, or without a run at the configuration of its modes.  If bodies move far, their
/// outline at the end of the run is added.
std::string machine_figure(const Result &result);

/// The deformed machine at the main peak of a run; empty if there is none.
std::string peak_figure(const Result &result);

/// Pictures of the lowest modes of the "coupled" machine or of the "frame".
std::string mode_pictures(const std::vector<coupling::Mode> &modes, const std::string &of, std::size_t most);

} // namespace gestell::apps

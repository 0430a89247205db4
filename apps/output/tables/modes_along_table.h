#pragma once

#include "apps/output/values/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace gestell::apps
{

/// modes_along.csv: one row per position and line, full precision, SI.
std::string modes_along_csv(const AlongResult &along);

/// modes_along_shapes.csv: the shapes to these rows, mass normalised, one column per coordinate of the machine.
std::string modes_along_shapes_csv(const AlongResult &along, const std::vector<std::string> &coordinates);

} // namespace gestell::apps

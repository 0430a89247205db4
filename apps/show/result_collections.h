#pragma once

#include "apps/show/picture_request.h"

#include <optional>

namespace gestell::apps
{

/// The data sets of a .pvd file by their times, ascending; parts in their order.
/// @throws std::invalid_argument for a broken file, or one that names a missing file.
std::vector<PictureFrame> read_collection(const std::filesystem::path &pvd);

/// The time [s] of the main peak, from summary.json; empty if there is none.
std::optional<double> peak_time(const std::filesystem::path &results);

/// Pictures of a result: the machine at its peak, its motion, its modes.
/// @throws std::invalid_argument if the folder contains none of these.
std::vector<PictureSeries> pictures_of(const std::filesystem::path &results, std::size_t most_modes);

} // namespace gestell::apps

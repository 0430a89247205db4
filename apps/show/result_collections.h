#pragma once

#include "apps/show/picture_request.h"

#include <optional>

namespace gestell::apps
{

/// The data sets of a .pvd file by their times, ascending; parts in their order.
/// @throws std::invalid_argument of a file that is broken, or names one that is missing.
std::vector<PictureFrame> read_collection(const std::filesystem::path &pvd);

/// The time [s] of the main peak, as summary.json tells it; nothing where there is none.
std::optional<double> peak_time(const std::filesystem::path &results);

/// What is to be drawn of a result: the machine at its peak, its motion, its modes.
/// @throws std::invalid_argument if the folder holds nothing of it.
std::vector<PictureSeries> pictures_of(const std::filesystem::path &results, std::size_t most_modes);

} // namespace gestell::apps

#pragma once

#include "coupling/reduced_frame.h"

#include <optional>
#include <string>

namespace gestell::coupling
{

/**
 * Writes a reduced frame as HDF5: matrices as datasets in column-major order (dimensions reversed, as HDF5 counts rows
 * first), one group per interface and output, and the format's version and the content key as attributes.  The file
 * appears complete or not at all: it is written beside its place and then renamed.  Equal frames give equal files.
 *
 * @param key  content key of what the frame was made from, see content_key(); may be empty.
 * @throws std::runtime_error if the folder cannot be made or the file not be written.
 * @throws std::invalid_argument for a frame that is not modal.
 */
void write_reduced_frame(const std::string &file, const ReducedFrame &frame, const std::string &key = {});

/// Reads what write_reduced_frame() wrote, bit by bit.
/// @throws std::invalid_argument if the file is missing, damaged, of another version or not a reduced frame.
ReducedFrame read_reduced_frame(const std::string &file);

/// The frame kept in the cache under this key: nothing if there is none, or if the file there is damaged or of another
/// version or key; the reason is then appended to `note` (the frame has to be made anew).
std::optional<ReducedFrame> find_in_cache(const std::string &key, std::string &note);

/// Keeps the frame in the cache.  A cache that cannot be written is no failure: the reason is returned, else "".
std::string keep_in_cache(const std::string &key, const ReducedFrame &frame);

/// $GESTELL_CACHE, else $XDG_CACHE_HOME/gestell, else ~/.cache/gestell.
std::string cache_folder();
/// Where the frame of this key is kept.
std::string cache_file(const std::string &key);

} // namespace gestell::coupling

#pragma once

#include "coupling/frame/reduced_frame_file.h"

#include <cstdint>
#include <ctime>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// The frame stored in the cache under this key: nothing if there is none, or if its file is damaged, of another
/// version or key, or of another user (foreign()); the reason is then appended to `note` (the frame has to be reduced
/// again). Found frames count as used now.
std::optional<StoredFrame> find_in_cache(const std::string &key, std::string &note);

/// Stores the frame in the cache under the key of its recipe, if the recipe determines the frame completely. A cache
/// that cannot be written does not cause a failure: the reason is returned, else "".
std::string keep_in_cache(const ReducedFrame &frame, const FrameOrigin &origin);

/// A frame, and whether it was read from the cache or reduced.
struct CachedFrame
{
  ReducedFrame frame;
  bool         from_cache = false; ///< read from the cache, not computed now
  double       cpu        = 0.;    ///< [s] CPU time of its reduction, now or as stored; 0: unknown
};

/// The frame of a recipe from the cache, otherwise from `make`, which is then stored.
/// @return a stored frame without notes; a new one with notes in cache_notes: why a stored one was not used or the new
/// one not stored
/// @throws the exceptions of `make`; nothing is stored then
CachedFrame cached_or_made(const FrameOrigin &origin, const std::function<ReducedFrame()> &make);

/// CPU time [s] that this process would have needed with an empty cache: fem::cpu_time() plus, once for each frame read
/// from the cache, the stored CPU time of its reduction.
double cpu_time_without_cache();

/// The file of a condensed part of a frame under this key, see title_of_parts; "": there is none that can be used.
std::string find_part_in_cache(const std::string &key);

/// Stores such a file by `write`, which gets its path.  @return "" or the reason why it is not stored
std::string keep_part_in_cache(const std::string &key, const std::function<void(const std::string &file)> &write);

/// Path of the frame of this key in cache_folder(); "": none.
std::string cache_file(const std::string &key);

/// A file of the cache.
struct CacheEntry
{
  std::string    file, key;
  std::uintmax_t bytes     = 0;
  std::time_t    last_used = 0;
  std::string    defect;          ///< why it cannot be used; "": it can
  FrameOrigin    origin;          // empty if it cannot be used
  bool           is_part = false; ///< a condensed part of a frame
  int            n_full = 0, n_interface = 0, n_modes = 0;
};

/// How much of each file is read.
enum class CacheCheck
{
  heads,   ///< head, origin and sizes: damage of the numbers is not detected
  contents ///< all of it, with its checksum, as for use
};

/// All files of the cache, the most recently used first: frames, parts of frames and unfinished files. Other files are
/// not listed.
std::vector<CacheEntry> cache_entries(CacheCheck check = CacheCheck::heads);

/// Why this frame of the cache cannot be used, after reading its whole file; "": it can.
std::string content_defect(const CacheEntry &entry);

/// The usable frame whose recipe differs from this one in the fewest ingredients; none if the cache has no frame.
std::optional<CacheEntry> nearest_entry(const std::vector<CacheEntry> &entries, const Recipe &recipe);

/// Removes an entry.  @return "" or the reason why it is still there.
std::string remove_entry(const CacheEntry &entry);

} // namespace gestell::coupling

#include "coupling/frame/frame_cache.h"

#include "coupling/frame/atomic_file.h"
#include "coupling/frame/cache_folder.h"
#include "coupling/frame/checksummed_file.h"
#include "fem/process/cpu_time.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <set>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

namespace fs = std::filesystem;

bool is_key(const std::string &text)
{
  constexpr std::size_t key_length = 64; // digits of SHA-256
  return text.size() == key_length && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

void require_named_after(const FrameOrigin &origin, const std::string &key)
{
  if (content_key(origin.recipe) != key)
    throw std::runtime_error("was made from other inputs than its name states");
}

/// Refuses a frame of another user, which may contain anything.
void require_own(const std::string &file)
{
  for (const std::string &path : {fs::path(file).parent_path().string(), file})
    if (const std::string reason = foreign(path); !reason.empty())
      throw std::runtime_error(std::string("is not used: ") + (path == file ? "it " : "its folder ") + reason);
}

/// Reads the frame of a file that is named after its key.
StoredFrame read_entry(const std::string &file, const std::string &key)
{
  require_own(file);
  StoredFrame stored = read_stored_frame(file);
  require_named_after(stored.origin, key);
  return stored;
}

/// Reads the whole file of a part.
void check_part(const std::string &file, const std::string &key)
{
  require_own(file);
  if (const std::string defect = seal_defect(file, title_of_parts); !defect.empty())
    throw std::runtime_error(defect);
  require_named_after(read_frame_summary(file).origin, key);
}

void describe(CacheEntry &entry)
{
  try
  {
    require_own(entry.file);
    FrameSummary summary = read_frame_summary(entry.file);
    require_named_after(summary.origin, entry.key);
    entry.origin      = std::move(summary.origin);
    entry.n_full      = summary.n_full;
    entry.n_interface = summary.n_interface;
    entry.n_modes     = summary.n_modes;
    entry.is_part     = summary.is_part;
  }
  catch (const std::runtime_error &failure)
  {
    entry.defect = failure.what();
  }
}

} // namespace

namespace
{

constexpr fs::perms written_by_others = fs::perms::group_write | fs::perms::others_write;

/// Creates the folder. An existing folder is used unchanged, unless other users can change its files.
void make_own_folder(const fs::path &folder)
{
  std::error_code error;
  const bool      made = fs::create_directories(folder, error);
  if (error)
    throw std::runtime_error(folder.string() + " cannot be created (" + error.message() +
                             "); name another folder with GESTELL_CACHE");
  if (made)
    fs::permissions(folder, written_by_others, fs::perm_options::remove);
  if (const std::string reason = foreign(folder.string()); !reason.empty())
    throw std::runtime_error(folder.string() + " " + reason + "; name your own folder with GESTELL_CACHE");
}

} // namespace

std::string cache_file(const std::string &key)
{
  const fs::path folder = cache_folder();
  return folder.empty() ? "" : (folder / (key + ".h5")).string();
}

std::optional<StoredFrame> find_in_cache(const std::string &key, std::string &note)
{
  const std::string file = cache_file(key);
  std::error_code   error;
  if (file.empty() || !fs::exists(file, error))
    return {};
  try
  {
    StoredFrame stored = read_entry(file, key);
    fs::last_write_time(file, fs::file_time_type::clock::now(), error); // fails in a read-only cache, which is valid
    return stored;
  }
  catch (const std::runtime_error &failure)
  {
    note += "cache: " + file + " " + failure.what() + "; the frame is reduced again";
    return {};
  }
}

std::string find_part_in_cache(const std::string &key)
{
  const std::string file = cache_file(key);
  std::error_code   error;
  if (file.empty() || !fs::exists(file, error))
    return {};
  try
  {
    check_part(file, key);
    fs::last_write_time(file, fs::file_time_type::clock::now(), error); // as in find_in_cache()
    return file;
  }
  catch (const std::runtime_error &)
  {
    return {}; // the part is condensed again and replaces it
  }
}

std::string keep_in_cache(const ReducedFrame &frame, const FrameOrigin &origin)
{
  if (const std::string beyond = beyond_the_files(origin.recipe); !beyond.empty())
    return "cache: the reduced frame is not stored: " + beyond + ", so the frame does not depend on its files only";
  return keep_part_in_cache(content_key(origin.recipe),
                            [&](const std::string &file) { write_reduced_frame(file, frame, origin); });
}

std::string keep_part_in_cache(const std::string &key, const std::function<void(const std::string &file)> &write)
{
  const std::string file = cache_file(key);
  if (file.empty())
    return "cache: the reduced frame is not stored: this user has no home folder; name one with GESTELL_CACHE";
  try
  {
    make_own_folder(fs::path(file).parent_path());
    remove_abandoned(fs::path(file).parent_path().string());
    write(file);
    fs::permissions(file, written_by_others, fs::perm_options::remove);
    return {};
  }
  catch (const std::exception &failure)
  {
    return "cache: the reduced frame is not stored for the next run: " + std::string(failure.what());
  }
}

namespace
{

/// CPU time of the reductions of frames found in the cache [s].
class SavedTime
{
public:
  void add(const std::string &key, double seconds)
  {
    const std::lock_guard<std::mutex> while_changed(mutex_);
    each_time_ += seconds;
    once_ += keys_.insert(key).second ? seconds : 0.;
  }
  /// @param each_time  a frame that is read twice counts twice, not once
  double seconds(bool each_time)
  {
    const std::lock_guard<std::mutex> while_changed(mutex_);
    return each_time ? each_time_ : once_;
  }

private:
  std::mutex            mutex_;
  std::set<std::string> keys_;
  double                once_ = 0., each_time_ = 0.;
};

SavedTime &saved_time()
{
  static SavedTime saved;
  return saved;
}

} // namespace

double cpu_time_without_cache()
{
  return fem::cpu_time() + saved_time().seconds(false);
}

CachedFrame cached_or_made(const FrameOrigin &origin, const std::function<ReducedFrame()> &make)
{
  const std::string key = content_key(origin.recipe);
  std::string       note;
  if (auto known = find_in_cache(key, note))
  {
    saved_time().add(key, known->origin.cpu);
    return {std::move(known->frame), true, known->origin.cpu};
  }
  const auto   now   = [] { return fem::cpu_time() + saved_time().seconds(true); }; // its parts may have been found
  const double begin = now();
  ReducedFrame frame = make();
  FrameOrigin  made  = origin;
  made.cpu           = now() - begin;
  saved_time().add(key, 0.); // when found later, it has been counted
  for (const std::string &text : {note, keep_in_cache(frame, made)})
    if (!text.empty())
      frame.cache_notes.push_back(text);
  return {std::move(frame), false, made.cpu};
}

std::string content_defect(const CacheEntry &entry)
{
  if (!entry.defect.empty())
    return entry.defect;
  try
  {
    if (entry.is_part)
      check_part(entry.file, entry.key);
    else
      read_entry(entry.file, entry.key);
    return {};
  }
  catch (const std::runtime_error &failure)
  {
    return failure.what();
  }
}

std::vector<CacheEntry> cache_entries(CacheCheck check)
{
  std::vector<CacheEntry> entries;
  std::error_code         error;
  for (fs::directory_iterator at(cache_folder(), error), end; !error && at != end; at.increment(error))
  {
    CacheEntry  entry;
    struct stat status;
    entry.file = at->path().string();
    if (stat(entry.file.c_str(), &status) != 0 || !S_ISREG(status.st_mode))
      continue;
    entry.bytes     = std::uintmax_t(status.st_size);
    entry.last_used = status.st_mtime;
    entry.key       = at->path().stem().string();
    if (is_key(entry.key) && at->path().extension() == ".h5")
      describe(entry);
    else if (abandoned(entry.file))
      entry.defect = "is incomplete";
    else
      continue;
    if (check == CacheCheck::contents)
      entry.defect = content_defect(entry);
    entries.push_back(std::move(entry));
  }
  std::sort(entries.begin(), entries.end(),
            [](const CacheEntry &a, const CacheEntry &b)
            { return a.last_used != b.last_used ? a.last_used > b.last_used : a.file < b.file; });
  return entries;
}

std::optional<CacheEntry> nearest_entry(const std::vector<CacheEntry> &entries, const Recipe &recipe)
{
  const CacheEntry *nearest = nullptr;
  std::size_t       fewest  = 0;
  for (const CacheEntry &entry : entries)
    if (entry.defect.empty() && !entry.is_part)
      if (const auto count = differences(entry.origin.recipe, recipe).size(); !nearest || count < fewest)
      {
        nearest = &entry;
        fewest  = count;
      }
  return nearest ? std::optional<CacheEntry>(*nearest) : std::nullopt;
}

std::string remove_entry(const CacheEntry &entry)
{
  std::error_code error;
  fs::remove(entry.file, error);
  return error ? entry.file + ": cannot be removed: " + error.message() : std::string();
}

} // namespace gestell::coupling

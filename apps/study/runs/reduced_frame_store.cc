#include "apps/study/runs/reduced_frame_store.h"

#include "apps/scene/build/build_machine.h"
#include "apps/session/prepared_machine.h"
#include "coupling/frame/frame_cache.h"
#include "coupling/frame/frame_recipe.h"

#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace gestell::apps
{
namespace
{

/// Holds the lock while it lives; where its file cannot be made, processes do not wait for each other.
class FileLock
{
public:
  explicit FileLock(const std::string &path)
  {
    if (path.empty())
      return;
    std::error_code none;
    std::filesystem::create_directories(std::filesystem::path(path).parent_path(), none);
    file_ = open(path.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0644);
    if (file_ >= 0)
      flock(file_, LOCK_EX);
  }
  ~FileLock()
  {
    if (file_ >= 0)
      close(file_);
  }
  FileLock(const FileLock &) = delete;

private:
  int file_ = -1;
};

/// "" without a cache.
std::string lock_file(const std::string &key)
{
  const std::string file = coupling::cache_file(key);
  return file.empty() ? "" : file + ".lock";
}

/// A file and its state: another one written in its place, or into it, has another.
std::string key_of_file(const std::string &path)
{
  struct stat state = {};
  if (stat(path.c_str(), &state) != 0)
    return path; // that it cannot be read is told by its reader
  std::string key = path;
  for (const auto number : {long(state.st_dev), long(state.st_ino), long(state.st_size), long(state.st_mtim.tv_sec),
                            long(state.st_mtim.tv_nsec), long(state.st_ctim.tv_sec), long(state.st_ctim.tv_nsec)})
    key += ' ' + std::to_string(number);
  return key;
}

/// What a machine needs of its frame, without what is only drawn unless that is wanted.
std::shared_ptr<const coupling::ReducedFrame> shared(coupling::ReducedFrame frame, bool drawn)
{
  if (!drawn)
  {
    frame.points       = {};
    frame.triangles    = {};
    frame.displacement = {};
    frame.stress       = {};
  }
  return std::make_shared<const coupling::ReducedFrame>(std::move(frame));
}

} // namespace

bool ReducedFrameStore::serves(const Scene &scene)
{
  const FramePath path = frame_path(scene);
  return !scene.reduction.superposition && (path == FramePath::reduce || path == FramePath::from_file);
}

std::shared_ptr<const coupling::ReducedFrame> ReducedFrameStore::frame(const Scene              &scene,
                                                                       const coupling::Progress &progress)
{
  if (!serves(scene))
    return nullptr;
  const bool        drawn = drawn_ || scene.stress.given;
  const bool        made  = frame_path(scene) == FramePath::reduce;
  const std::string key =
      made ? coupling::content_key(frame_origin(scene).recipe) : key_of_file(scene.frame.reduced_file);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept &kept) { return kept.first == key; });
  if (found != kept_.end())
  {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().second;
  }
  if (!made)
    kept_.emplace_front(key, shared(coupling::read_reduced_frame(scene.frame.reduced_file), drawn));
  else
  {
    const FileLock        alone(lock_file(key));
    coupling::CachedFrame frame = reduced_frame(scene, progress);
    kept_.emplace_front(key, shared(std::move(frame.frame), drawn));
    n_reduced_ += !frame.from_cache;
  }
  constexpr std::size_t most_kept = 3; // frames: studies vary few, and each keeps its memory
  if (kept_.size() > most_kept)
    kept_.pop_back();
  return kept_.front().second;
}

} // namespace gestell::apps

#include "apps/session/reduced_frame_store.h"

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

/// Holds the lock during its lifetime; if its file cannot be created, processes do not wait for each other.
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

/// Lock file of a frame; empty without a cache.
std::string lock_file(const std::string &key)
{
  const std::string file = coupling::cache_file(key);
  return file.empty() ? "" : file + ".lock";
}

/// Key of a file in its present state: a file that was replaced or changed has another key.
std::string key_of_file(const std::string &path)
{
  struct stat state = {};
  if (stat(path.c_str(), &state) != 0)
    return path; // its reader reports that it cannot be read
  std::string key = path;
  for (const auto number : {long(state.st_dev), long(state.st_ino), long(state.st_size), long(state.st_mtim.tv_sec),
                            long(state.st_mtim.tv_nsec), long(state.st_ctim.tv_sec), long(state.st_ctim.tv_nsec)})
    key += ' ' + std::to_string(number);
  return key;
}

std::string key_of_frame(const Scene &scene)
{
  return coupling::content_key(frame_origin(scene).recipe);
}

} // namespace

bool on_reduced_frame(const Scene &scene)
{
  const FramePath path = frame_path(scene);
  return !scene.reduction.superposition && (path == FramePath::reduce || path == FramePath::from_file);
}

bool same_frame(const Scene &a, const Scene &b)
{
  return frame_path(a) != FramePath::reduce || key_of_frame(a) == key_of_frame(b);
}

coupling::ReducedFrame without_pictures(coupling::ReducedFrame frame)
{
  frame.points       = {};
  frame.triangles    = {};
  frame.displacement = {};
  frame.stress       = {};
  return frame;
}

PreparedScene prepared_scene(Scene scene, const coupling::ReducedFrame *frame)
{
  auto own      = std::make_unique<Scene>(std::move(scene));
  auto prepared = std::make_unique<PreparedMachine>(prepare_machine(*own, {}, frame));
  return {std::move(own), std::move(prepared)};
}

std::shared_ptr<const coupling::ReducedFrame> ReducedFrameStore::frame(const Scene              &scene,
                                                                       const coupling::Progress &progress)
{
  if (!on_reduced_frame(scene))
    return nullptr;
  const bool        made = frame_path(scene) == FramePath::reduce;
  const std::string key  = made ? key_of_frame(scene) : key_of_file(scene.frame.reduced_file);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept &kept) { return kept.first == key; });
  if (found != kept_.end())
  {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().second;
  }
  const FileLock         alone(made ? lock_file(key) : "");
  coupling::ReducedFrame frame =
      made ? reduced_frame(scene, progress).frame : coupling::read_reduced_frame(scene.frame.reduced_file);
  if (!drawn_ && !scene.frame.geometry.stress)
    frame = without_pictures(std::move(frame));
  kept_.emplace_front(key, std::make_shared<const coupling::ReducedFrame>(std::move(frame)));
  constexpr std::size_t most_kept = 3; // frames: studies vary few, and each keeps its memory
  if (kept_.size() > most_kept)
    kept_.pop_back();
  return kept_.front().second;
}

} // namespace gestell::apps

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Locks a folder of results during its lifetime, so that no other process writes there: an operating-system lock on the
 * file `.gestell-lock` in the folder, released however the process ends. The file contains the process, the computer
 * and the activity. The destructor removes the file, and folders that the lock made if they are still empty.
 *
 * On file systems without locks the folder is not locked; note() gives the reason.
 */
class FolderLock
{
public:
  enum class Kind
  {
    alone,
    beside_others ///< of the same kind; the file remains, because others may have locked it
  };

  /// Makes the folder if it is missing; it must be writable (require_writable()).
  /// @param doing    activity, for the error message of other processes: "is computing results for it"
  /// @param way_out  for the error message of this process: the alternative to waiting
  /// @throws std::invalid_argument with the process that has locked the folder
  FolderLock(const std::filesystem::path &folder, Kind kind, const std::string &doing, const std::string &way_out);
  /// Locks exclusively, for a process that writes results.
  explicit FolderLock(const std::filesystem::path &folder);
  ~FolderLock();
  FolderLock(const FolderLock &)            = delete;
  FolderLock &operator=(const FolderLock &) = delete;

  /// Reason why the folder is not locked; empty: it is locked.
  const std::string &note() const { return note_; }

private:
  bool        open_file();
  bool        is_still_there() const;
  void        take(const std::string &doing, const std::string &way_out);
  void        give_up();
  std::string release() const;

  std::filesystem::path              reported_, folder_, path_; ///< the folder as given, as absolute path, its lock
  Kind                               kind_;
  int                                process_;
  std::vector<std::filesystem::path> made_; ///< folders, outermost first
  std::string                        note_;
  int                                file_ = -1; ///< -1: not locked
};

/// Shell commands that remove the lock files of this process, for a process that ends without running destructors.
std::string words_of_release();

} // namespace gestell::apps

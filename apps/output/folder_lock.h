#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Holds a folder of results while it lives, so that no other process writes there at the same time: a lock of the
 * operating system on the file `.gestell-lock` in it, which ends with the process, however that ends.  The file names
 * process, computer and what they do; it goes with the lock, and so do folders that the lock made and nothing was put
 * into.
 *
 * On file systems without locks nothing is held: note() says so.
 */
class FolderLock
{
public:
  enum class Kind
  {
    alone,
    beside_others ///< of the same kind; the file stays, as others may hold it
  };

  /// Makes the folder if it is missing; it must be writable (require_writable()).
  /// @param doing  for those who are refused: "is computing results for it"
  /// @param way_out  for who is refused here: what may be done but to wait
  /// @throws std::invalid_argument with the process that holds the folder
  FolderLock(const std::filesystem::path &folder, Kind kind, const std::string &doing, const std::string &way_out);
  /// One that writes results there alone.
  explicit FolderLock(const std::filesystem::path &folder);
  ~FolderLock();
  FolderLock(const FolderLock &)            = delete;
  FolderLock &operator=(const FolderLock &) = delete;

  /// Why nothing is held; empty: the folder is.
  const std::string &note() const { return note_; }

private:
  bool        open_file();
  bool        is_still_there() const;
  void        take(const std::string &doing, const std::string &way_out);
  void        give_up();
  std::string release() const;

  std::filesystem::path              reported_, folder_, path_; ///< the folder as it was given, whole, and its file
  Kind                               kind_;
  int                                process_;
  std::vector<std::filesystem::path> made_; ///< folders, outermost first
  std::string                        note_;
  int                                file_ = -1; ///< -1: nothing is held
};

/// Words for a shell that remove what the locks of this process would: for a process that ends without their
/// destructors.
std::string words_of_release();

} // namespace gestell::apps

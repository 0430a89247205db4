#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace gestell::coupling
{

/// A file could not be written: the disk is full, the folder gone.  What it was to hold is not wrong.
struct WriteFailure : std::runtime_error
{
  using std::runtime_error::runtime_error;
  /// "results/history.csv: cannot be written (No space left on device); check ..."
  WriteFailure(const std::string &path, const std::error_code &reason);
};

/**
 * The place beside a file's own where it is written until it is whole, for writers that want a path.
 *
 * The name is one that no other process uses, here or on another machine.  What stood in the file's place stays until
 * finish(), and for good where writing fails.
 */
class FileBeside
{
public:
  explicit FileBeside(const std::string &path); ///< in a folder that exists; makes nothing
  ~FileBeside();                                ///< removes what was not finished
  FileBeside(const FileBeside &)            = delete;
  FileBeside &operator=(const FileBeside &) = delete;

  const std::string &place() const { return nearby_; } ///< to write to
  const std::string &path() const { return path_; }    ///< where the file appears

  /// Renames it; the writer has closed it.  @throws WriteFailure; nothing has changed then
  void finish();

private:
  std::string path_, nearby_;
};

/// A file that appears whole or not at all: a stream to the place beside it.
class AtomicFile
{
public:
  explicit AtomicFile(const std::string &path); ///< in a folder that exists

  std::ostream &stream() { return out_; }

  /// @throws WriteFailure with path, reason and remedy; nothing has changed then
  void finish();

private:
  FileBeside    file_;
  std::ofstream out_;
};

/// Whether `path` is what a process that was killed left of a file: a plain file named as unfinished ones are, that
/// was untouched for an hour.
bool abandoned(const std::string &path);

/// Removes what is abandoned in a folder, as far as that is possible.
void remove_abandoned(const std::string &folder);

} // namespace gestell::coupling

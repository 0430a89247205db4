#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

namespace gestell::coupling
{

/// A file could not be written: the disk is full, the folder missing. Its contents are valid.
struct WriteFailure : std::runtime_error
{
  using std::runtime_error::runtime_error;
  /// "results/history.csv: cannot be written (No space left on device); check ..."
  WriteFailure(const std::string &path, const std::error_code &reason);
};

/**
 * Temporary path next to the target file, for writers that need a path. No other process uses its name, here or on
 * another computer. The old file stays until finish(), and permanently if writing fails.
 */
class FileBeside
{
public:
  explicit FileBeside(const std::string &path); ///< in an existing folder; creates nothing
  ~FileBeside();                                ///< removes an unfinished file
  FileBeside(const FileBeside &)            = delete;
  FileBeside &operator=(const FileBeside &) = delete;

  const std::string &place() const { return nearby_; } ///< to write to
  const std::string &path() const { return path_; }    ///< where the file appears

  /// Renames it; the writer has closed it.  @throws WriteFailure; nothing has changed then
  void finish();

private:
  std::string path_, nearby_;
};

/// An atomically written file: a stream to a temporary file, then a rename.
class AtomicFile
{
public:
  explicit AtomicFile(const std::string &path); ///< in an existing folder

  std::ostream &stream() { return out_; }

  /// @throws WriteFailure with path, reason and remedy; the old file is unchanged then
  void finish();

private:
  FileBeside    file_;
  std::ofstream out_;
};

/// Whether `path` is the unfinished file of a killed process: a regular file with the name of unfinished ones,
/// unchanged for an hour.
bool abandoned(const std::string &path);

/// Removes abandoned files of a folder; failures are ignored.
void remove_abandoned(const std::string &folder);

} // namespace gestell::coupling

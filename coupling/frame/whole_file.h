#pragma once

#include <fstream>
#include <string>

namespace gestell::coupling
{

/**
 * A file that appears whole or not at all.
 *
 * It is written beside its place under a name that no other process uses, here or on another machine, and renamed by
 * finish().  What stood in its place stays until then, and for good where writing fails.
 */
class WholeFile
{
public:
  explicit WholeFile(const std::string &path); ///< in a folder that exists
  ~WholeFile();                                ///< removes what was not finished
  WholeFile(const WholeFile &)            = delete;
  WholeFile &operator=(const WholeFile &) = delete;

  std::ostream &stream() { return out_; }

  /// @throws std::runtime_error with path, reason and remedy; nothing has changed then
  void finish();

private:
  std::string   path_, beside_;
  std::ofstream out_;
};

/// Whether `path` is what a process that was killed left of a file: named as unfinished and untouched for an hour.
bool abandoned(const std::string &path);

} // namespace gestell::coupling

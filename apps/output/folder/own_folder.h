#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

namespace gestell::apps
{

/// Whether a name matches a pattern in which '*' stands for any letters except '/', or none.
bool has_form(const std::string &name, const std::string &pattern);

/**
 * A folder for results, and the list of those of its files that are ours.
 *
 * The list `.gestell-files` names every file that this program wrote there, one per line, relative to the folder. A
 * name is entered before its file appears, so that the list is complete even if the process is killed. A file is ours
 * if the list names it, it is a plain file, and its path inside the folder contains no link. No other file is ever
 * replaced or removed.
 */
class OwnFolder
{
public:
  explicit OwnFolder(const std::filesystem::path &path); ///< changes nothing; the folder need not exist

  const std::filesystem::path &path() const { return path_; }

  bool owns(const std::string &name) const;

  /// Why `name` cannot be written: "charts is a link", "history.csv was not written by gestell"; "" if it can.  If the
  /// name ends in "/", only the folder is checked.
  std::string obstacle(const std::string &name) const;

  /**
   * Checks before the computation that files of these names can be written.
   *
   * @param patterns  names, with '*' for any letters, or folders that end in "/"
   * @param inputs    files that the command reads: none of them may be replaced
   * @throws std::invalid_argument with the obstructing file and the remedy
   */
  void require_free(const std::vector<std::string>           &patterns,
                    const std::vector<std::filesystem::path> &inputs = {}) const;

  /// Whether this name is one of the files, directly or through a link.
  bool is_any_of(const std::string &name, const std::vector<std::filesystem::path> &inputs) const;

  /// Returns the path of a file that is about to be written.  Enters it in the list, makes its folder and removes
  /// leftovers of killed processes there.
  /// @throws std::invalid_argument for an obstacle(), coupling::WriteFailure
  std::filesystem::path claim(const std::string &name);
  /// Enters an existing file whose content was recognised as ours.
  void adopt(const std::string &name);
  void write(const std::string &name, const std::string &content); ///< @throws as claim() does

  /// Removes a file if it is ours.
  void remove(const std::string &name);
  /// Removes all files of ours for which `goes` is true, folders that become empty, and leftovers of killed processes.
  void remove_all(const std::function<bool(const std::string &)> &goes);

private:
  void require_own_list() const;
  void enter(const std::string &name);
  void remove_abandoned(const std::string &inner);
  void keep_list(const std::set<std::string> &names);

  std::filesystem::path path_;
  std::set<std::string> names_;   ///< of the list
  std::set<std::string> cleared_; ///< folders in it without leftovers of killed processes
};

/// Writes and removes a test file in the folder, or in its first existing parent; returns the error, if any.
std::error_code probe(const std::filesystem::path &folder);

} // namespace gestell::apps

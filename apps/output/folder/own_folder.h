#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

namespace gestell::apps
{

/// Whether a name is one of a pattern in which a '*' stands for any letters, or none, but '/'.
bool has_form(const std::string &name, const std::string &pattern);

/**
 * A folder into which results are written, and which of its files are ours.
 *
 * The list `.gestell-files` names every file that this program wrote there, a line each, relative to the folder.  A
 * name is entered before its file appears, so that the list is complete whenever a process is killed.  A file is ours
 * if the list names it, it is a plain file, and no link leads to it inside the folder.  Nothing else is ever replaced
 * or removed.
 */
class OwnFolder
{
public:
  explicit OwnFolder(const std::filesystem::path &path); ///< changes nothing; the folder need not exist

  const std::filesystem::path &path() const { return path_; }

  bool owns(const std::string &name) const;

  /// Why `name` cannot be written: "charts is a link", "history.csv was not written by gestell"; "" if it can.  Of a
  /// name that ends in "/" the folder alone is judged.
  std::string obstacle(const std::string &name) const;

  /**
   * Whether files of these names can be written, before anything is computed.
   *
   * @param patterns  of names, '*' for any letters, or folders that end in "/"
   * @param inputs    files that the command reads: none of them may be replaced
   * @throws std::invalid_argument with the file in the way and the remedy
   */
  void require_free(const std::vector<std::string>           &patterns,
                    const std::vector<std::filesystem::path> &inputs = {}) const;

  /// Whether this name is one of the files, by itself or by a link.
  bool is_any_of(const std::string &name, const std::vector<std::filesystem::path> &inputs) const;

  /// The place of a file to be written: enters it in the list, makes its folder, in which what killed processes left
  /// goes.
  /// @throws std::invalid_argument for an obstacle(), coupling::WriteFailure
  std::filesystem::path claim(const std::string &name);
  /// Enters a file that is there and whose content has proved to be ours.
  void adopt(const std::string &name);
  void write(const std::string &name, const std::string &content); ///< @throws as claim()

  /// Removes a file if it is ours.
  void remove(const std::string &name);
  /// Removes all of ours for which `goes` is true, folders that are empty then, and what killed processes left.
  void remove_all(const std::function<bool(const std::string &)> &goes);

private:
  void require_own_list() const;
  void enter(const std::string &name);
  void remove_abandoned(const std::string &inner);
  void keep_list(const std::set<std::string> &names);

  std::filesystem::path path_;
  std::set<std::string> names_;   ///< of the list
  std::set<std::string> cleared_; ///< folders in it that hold nothing abandoned
};

/// Writes a file and removes it in the folder, or above it in the first one that exists; why that failed, or none.
std::error_code probe(const std::filesystem::path &folder);

} // namespace gestell::apps

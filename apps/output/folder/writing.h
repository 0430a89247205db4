#pragma once

#include "apps/output/folder/own_folder.h"

#include <memory>
#include <stdexcept>

namespace gestell::apps
{

/// Writes the files of a result into a folder and collects the failures.
class Writing
{
public:
  explicit Writing(const std::filesystem::path &folder) : folder_(folder) {}

  const std::vector<std::string> &names() const { return names_; }       ///< written, relative to the folder
  const std::vector<std::string> &failures() const { return failures_; } ///< with the name of the file

  void write(const std::string &name, const std::string &content);

  /// Reserves space on the disk for a file that is written last; without effect if the file cannot be created.
  void keep_room(const std::string &name, std::size_t bytes);
  void give_room_back() { room_.clear(); }

  /// Writes files that are only useful together: all of them or none.
  /// @param write  takes the folder and the list of names; it appends each name before it writes the file
  template <typename Write>
  void together(const Write &write)
  {
    const std::size_t before = names_.size();
    try
    {
      write(folder_, names_);
    }
    catch (const std::runtime_error &failure) // for example a full disk
    {
      give_up(before, failure.what());
    }
    catch (const std::invalid_argument &in_the_way)
    {
      give_up(before, in_the_way.what());
    }
  }

private:
  struct Room;
  void give_up(std::size_t before, const std::string &reason);

  OwnFolder                          folder_;
  std::vector<std::string>           names_, failures_;
  std::vector<std::shared_ptr<Room>> room_;
};

/**
 * Writes an expensive result. Files that cannot be written are skipped; the whole result is then written into a new
 * temporary folder.
 *
 * @return names of the files written
 * @throws coupling::WriteFailure after writing all other files if one could not be written: with the file, the reason,
 * and the folder of the result
 */
std::vector<std::string> write_or_rescue(const std::filesystem::path          &folder,
                                         const std::function<void(Writing &)> &write);

} // namespace gestell::apps

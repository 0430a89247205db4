#pragma once

#include "apps/output/folder/own_folder.h"

#include <memory>
#include <stdexcept>

namespace gestell::apps
{

/// The files of an answer, written into a folder as far as they can be.
class Writing
{
public:
  explicit Writing(const std::filesystem::path &folder) : folder_(folder) {}

  const std::vector<std::string> &names() const { return names_; }       ///< written, relative to the folder
  const std::vector<std::string> &failures() const { return failures_; } ///< what could not be written, and why

  void write(const std::string &name, const std::string &content);

  /// Takes the place of a file on the disk that is written last; nothing where there is none.
  void keep_room(const std::string &name, std::size_t bytes);
  void give_room_back() { room_.clear(); }

  /// Files that are of use together: all of them are written or none.
  /// @param write  takes the folder and the list of names, which it extends by each name before it writes it
  template <typename Write>
  void together(const Write &write)
  {
    const std::size_t before = names_.size();
    try
    {
      write(folder_, names_);
    }
    catch (const std::runtime_error &failure) // the disk
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
 * Writes an answer that was long in the making: what cannot be written is left out, and all of it then goes into a new
 * folder for temporary files.
 *
 * @return names of the files written
 * @throws coupling::WriteFailure if a file could not be written, when all others are: with the file, the reason, and
 * where the answer is
 */
std::vector<std::string> write_or_rescue(const std::filesystem::path          &folder,
                                         const std::function<void(Writing &)> &write);

} // namespace gestell::apps

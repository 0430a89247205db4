#include "apps/output/folder/writing.h"

#include "coupling/frame/atomic_file.h"

#include <cstdlib>

namespace gestell::apps
{
namespace fs = std::filesystem;

/// A file that never appears.
struct Writing::Room
{
  explicit Room(const fs::path &place, std::size_t bytes) : file(place.string())
  {
    file.stream() << std::string(bytes, ' ') << std::flush;
  }
  coupling::AtomicFile file;
};

void Writing::keep_room(const std::string &name, std::size_t bytes)
{
  try
  {
    room_.push_back(std::make_shared<Room>(folder_.claim(name), bytes));
  }
  catch (const coupling::WriteFailure &) // reported when the file is written
  {
  }
  catch (const std::invalid_argument &)
  {
  }
}

void Writing::write(const std::string &name, const std::string &content)
{
  together(
      [&](OwnFolder &folder, std::vector<std::string> &names)
      {
        names.push_back(name);
        folder.write(name, content);
      });
}

void Writing::give_up(std::size_t before, const std::string &reason)
{
  for (std::size_t i = before; i < names_.size(); ++i)
    folder_.remove(names_[i]);
  names_.resize(before);
  failures_.push_back(reason);
}

namespace
{

/// "" if it cannot be written there either.
fs::path written_elsewhere(const std::function<void(Writing &)> &write)
{
  std::error_code error;
  std::string     name = (fs::temp_directory_path(error) / "gestell_results_XXXXXX").string();
  if (error || !::mkdtemp(name.data()))
    return "";
  Writing writing(name);
  write(writing);
  if (writing.failures().empty())
    return name;
  fs::remove_all(name, error);
  return "";
}

} // namespace

std::vector<std::string> write_or_rescue(const fs::path &folder, const std::function<void(Writing &)> &write)
{
  Writing writing(folder);
  write(writing);
  const std::size_t n_failures = writing.failures().size();
  if (n_failures == 0)
    return writing.names();
  std::string message = writing.failures().front();
  if (n_failures > 1)
    message += "\n  " + std::to_string(n_failures - 1) + " more files or series of files could not be written";
  const fs::path elsewhere = written_elsewhere(write);
  throw coupling::WriteFailure(message + (elsewhere.empty()
                                              ? "\n  all other results are in " + folder.string()
                                              : "\n  all results are in " + elsewhere.string() + " instead"));
}

} // namespace gestell::apps

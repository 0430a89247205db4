#include "tests/fuzz/target.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <typeinfo>

namespace gestell::fuzz
{
namespace
{

namespace fs = std::filesystem;

/// In memory where the system has files there; gone with the process.
class Folder
{
public:
  Folder()
  {
    std::error_code none;
    const fs::path  memory = "/dev/shm";
    std::string     name =
        ((!std::getenv("TMPDIR") && fs::is_directory(memory, none) ? memory : fs::temp_directory_path()) /
         "gestell_XXXXXX");
    if (!::mkdtemp(name.data()))
      throw std::runtime_error("no folder can be made: " + name);
    path_ = name;
  }
  ~Folder()
  {
    std::error_code none;
    fs::remove_all(path_, none);
  }
  const fs::path &path() const { return path_; }

private:
  fs::path path_;
};

/// What std::stoi and its like say, and a text that tells nobody anything.
bool is_of_the_reader(const std::string &message)
{
  static const std::vector<std::string> others = {"", "stoi", "stol", "stoul", "stod", "stoull"};
  return std::find(others.begin(), others.end(), message) == others.end();
}

} // namespace

const std::vector<Target> &targets()
{
  static const std::vector<Target> all = []
  {
    std::vector<Target> list;
    for (const auto &some : {scene_targets(), matrix_targets(), model_targets(), table_targets(), kept_targets()})
      list.insert(list.end(), some.begin(), some.end());
    std::sort(list.begin(), list.end(), [](const Target &a, const Target &b) { return a.name < b.name; });
    return list;
  }();
  return all;
}

const Target &target(const std::string &name)
{
  std::string names;
  for (const Target &own : targets())
    if (own.name == name)
      return own;
    else
      names += (names.empty() ? "" : ", ") + own.name;
  throw std::invalid_argument("there is no target '" + name + "'; there are " + names);
}

void promise(bool holds, const std::string &what)
{
  if (!holds)
    throw std::logic_error("finding: " + what);
}

void feed(const Target &target, const std::string &bytes)
{
  try
  {
    target.read(bytes);
  }
  catch (const std::invalid_argument &refused)
  {
    promise(is_of_the_reader(refused.what()), "a message that is none: '" + std::string(refused.what()) + "'");
  }
  catch (const std::logic_error &broken)
  {
    if (std::string(broken.what()).rfind("finding: ", 0) == 0)
      throw;
    throw std::logic_error(std::string("finding: ") + typeid(broken).name() + ": " + broken.what());
  }
  catch (const std::exception &other)
  {
    throw std::logic_error(std::string("finding: ") + typeid(other).name() + ": " + other.what());
  }
}

std::string file_of(const std::string &name, const std::string &bytes)
{
  static const Folder folder;
  const fs::path      file = folder.path() / name;
  std::ofstream(file, std::ios::binary) << bytes;
  return file.string();
}

} // namespace gestell::fuzz

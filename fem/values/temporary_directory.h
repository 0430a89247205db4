#pragma once

#include <filesystem>
#include <string>

namespace gestell::fem
{

/// A new folder for temporary files, accessible only to this user, with an unpredictable name; removed with its owner.
class TemporaryDirectory
{
public:
  TemporaryDirectory(); ///< @throws std::runtime_error with the reason, if none can be made
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory &)            = delete;
  TemporaryDirectory &operator=(const TemporaryDirectory &) = delete;

  const std::filesystem::path &path() const { return path_; }

private:
  std::filesystem::path path_;
};

/// Shell commands that remove all temporary folders of this process, if it ends without destructors.
std::string words_of_removal();

} // namespace gestell::fem

#pragma once

#include <filesystem>
#include <string>

namespace gestell::fem
{

/// A new folder for temporary files, for this user alone, under a name that nobody can foresee; gone with its owner.
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

/// Words for a shell that remove all that this process has: for one that ends without their destructors.
std::string words_of_removal();

} // namespace gestell::fem

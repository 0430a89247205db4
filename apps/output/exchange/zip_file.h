#pragma once

#include "coupling/frame/atomic_file.h"

#include <filesystem>
#include <string>

namespace gestell::apps
{

/// An archive that appears complete or not at all: a temporary file in the same folder, renamed by finish().  Equal
/// contents give equal bytes.
class ZipFile
{
public:
  static bool available(); ///< built with minizip

  /// @throws coupling::WriteFailure if it cannot be written
  explicit ZipFile(const std::filesystem::path &path);
  ~ZipFile(); ///< removes an unfinished archive
  ZipFile(const ZipFile &) = delete;

  /// @param name  "resources/scene.toml"
  void add(const std::string &name, const std::string &bytes);
  void finish(); ///< @throws coupling::WriteFailure

private:
  coupling::FileBeside place_;
  void                *zip_ = nullptr;
};

} // namespace gestell::apps

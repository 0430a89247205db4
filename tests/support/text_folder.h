#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace gestell::tests
{

/// A folder of files of one test, removed at the end.
class TextFolder
{
public:
  TextFolder() : path_(std::filesystem::temp_directory_path() / ("gestell_texts_" + std::to_string(getpid())))
  {
    std::filesystem::create_directories(path_);
  }
  ~TextFolder() { std::filesystem::remove_all(path_); }
  TextFolder(const TextFolder &) = delete;

  /// Path of a file with this text.
  std::string write(const std::string &name, const std::string &text) const
  {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return (path_ / name).string();
  }

private:
  std::filesystem::path path_;
};

} // namespace gestell::tests

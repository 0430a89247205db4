#pragma once

#include "tests/support/test.h"

#include <cstdio>
#include <sys/wait.h>
#include <unistd.h>

namespace gestell::tests
{

/// What a call of the program `gestell` gave back; standard output and standard error together.
struct Answer
{
  int         exit_code;
  std::string text;

  bool says(const std::string &part) const { return text.find(part) != std::string::npos; }
};

/// How often a part stands in a text.
inline int count(const std::string &text, const std::string &part)
{
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
    ++n;
  return n;
}

/// The number behind the first occurrence of every name of the path, in order, in a text of JSON.
inline double json_number(const std::string &json, const std::vector<std::string> &path)
{
  std::size_t at = 0;
  for (const std::string &name : path)
  {
    at = json.find('"' + name + "\":", at); // as a key, not as a text
    if (at == std::string::npos)
      throw std::invalid_argument("no " + name);
    at += name.size() + 3;
  }
  return std::stod(json.substr(json.find_first_of("0123456789-", at)));
}

/// The exit code of an answer, and what stands in it.
inline void expect_answer(const Answer &answer, int exit_code, const std::vector<std::string> &words)
{
  EXPECT_EQ(answer.exit_code, exit_code) << answer.text;
  for (const std::string &part : words)
    EXPECT_TRUE(answer.says(part)) << "not: " << part << "\n" << answer.text;
}

inline Answer shell(const std::string &command)
{
  Answer answer;
  FILE  *pipe = popen((command + " 2>&1").c_str(), "r");
  for (std::array<char, 4096> buffer; std::fgets(buffer.data(), buffer.size(), pipe);)
    answer.text += buffer.data();
  const int status = pclose(pipe);
  answer.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return answer;
}

/// Calls the program with an own cache that lasts as long as the build folder.
inline Answer gestell(const std::string &arguments)
{
  return shell("GESTELL_CACHE='" GESTELL_BINARY_DIR "/tests/cache' '" GESTELL_BINARY_DIR "/bin/gestell' " + arguments);
}

inline std::string scene(const std::string &name)
{
  return "'" GESTELL_SOURCE_DIR "/apps/scenes/" + name + "'";
}

inline std::string read(const std::filesystem::path &path)
{
  std::ifstream      file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// An empty folder that vanishes with the test.
class Folder
{
public:
  explicit Folder(const std::string &name)
      : path_(std::filesystem::temp_directory_path() / ("gestell_" + name + "_" + std::to_string(getpid())))
  {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }

  std::filesystem::path operator/(const std::string &name) const { return path_ / name; }
  std::string           option() const { return " --quiet -o '" + (path_ / "results").string() + "' "; }
  std::filesystem::path results() const { return path_ / "results"; }

  /// Writes a file; returns its path in quotes.
  std::string file(const std::string &name, const std::string &text) const
  {
    std::ofstream(path_ / name) << text;
    return "'" + (path_ / name).string() + "'";
  }

private:
  std::filesystem::path path_;
};

} // namespace gestell::tests

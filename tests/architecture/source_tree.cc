#include "tests/architecture/source_tree.h"

#include <algorithm>
#include <fstream>

namespace gestell::tests
{

namespace fs = std::filesystem;

namespace
{

bool starts_with(const std::string &text, const std::string &beginning)
{
  return text.compare(0, beginning.size(), beginning) == 0;
}

/// What .gitignore leaves out.
bool is_ignored(const std::string &name)
{
  return name == "build" || starts_with(name, "build-") || name == "results";
}

/// Folders of git, editors and language servers.
bool is_hidden_folder(const fs::directory_entry &entry)
{
  const std::string name = entry.path().filename().string();
  return entry.is_directory() && name.front() == '.' && name != ".ci";
}

std::vector<std::string> read_lines(const fs::path &path)
{
  constexpr std::uintmax_t largest = 2u << 20;
  if (fs::file_size(path) > largest)
    return {};

  std::vector<std::string> lines;
  std::ifstream            file(path, std::ios::binary);
  for (std::string line; std::getline(file, line); lines.push_back(line))
    if (line.find('\0') != std::string::npos)
      return {};
  return lines;
}

bool belongs(const std::string &path, const std::vector<std::string> &folders)
{
  return std::any_of(folders.begin(), folders.end(), [&](const auto &folder) { return starts_with(path, folder); });
}

} // namespace

std::vector<SourceFile> read_source_tree(const fs::path &root)
{
  std::vector<SourceFile> files;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator(); ++entry)
    if (entry.depth() == 0 && (is_ignored(entry->path().filename().string()) || is_hidden_folder(*entry)))
      entry.disable_recursion_pending();
    else if (entry->is_regular_file())
      files.push_back({fs::relative(entry->path(), root).generic_string(), read_lines(entry->path())});
  return files;
}

std::set<std::string> top_level_entries(const fs::path &root)
{
  std::set<std::string> names;
  for (const auto &entry : fs::directory_iterator(root))
    if (const std::string name = entry.path().filename().string(); name.front() != '.' && !is_ignored(name))
      names.insert(name);
  return names;
}

std::vector<std::string> lines_matching(const std::vector<SourceFile> &files, const std::vector<std::string> &folders,
                                        const std::vector<std::string> &except, const std::regex &pattern)
{
  std::vector<std::string> findings;
  for (const auto &[path, lines] : files)
    if (belongs(path, folders) && !belongs(path, except))
      for (std::size_t i = 0; i < lines.size(); ++i)
        if (std::regex_search(lines[i], pattern))
          findings.push_back(path + ":" + std::to_string(i + 1) + ": " + lines[i]);
  return findings;
}

std::vector<std::string> includes_matching(const std::vector<SourceFile>  &files,
                                           const std::vector<std::string> &folders,
                                           const std::vector<std::string> &except, const std::string &forbidden)
{
  return lines_matching(files, folders, except, std::regex("^\\s*#\\s*include\\s*[<\"](" + forbidden + ")"));
}

} // namespace gestell::tests

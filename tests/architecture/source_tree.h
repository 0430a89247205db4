#pragma once

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace gestell::tests
{

/// A text file of the project.
struct SourceFile
{
  std::string              path; ///< relative to the top, with slashes
  std::vector<std::string> lines;
};

/// Every text file below `root` that belongs to the project: not what .gitignore leaves out (build*, results), nor
/// hidden folders other than .ci.  Binary files and files over 2 MiB are listed without lines.
std::vector<SourceFile> read_source_tree(const std::filesystem::path &root);

/// Names directly below `root` that count: no dot files, no build*, no results.
std::set<std::string> top_level_entries(const std::filesystem::path &root);

/// Where a line of `files` whose path begins with one of `folders` (and with none of `except`) matches `pattern`:
/// "path:line: text", one per finding.
std::vector<std::string> lines_matching(const std::vector<SourceFile> &files, const std::vector<std::string> &folders,
                                        const std::vector<std::string> &except, const std::regex &pattern);

/// The same for #include lines: findings are includes that match `forbidden`.
std::vector<std::string> includes_matching(const std::vector<SourceFile>  &files,
                                           const std::vector<std::string> &folders,
                                           const std::vector<std::string> &except, const std::string &forbidden);

} // namespace gestell::tests

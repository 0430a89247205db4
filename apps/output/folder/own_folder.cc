#include "apps/output/folder/own_folder.h"

#include "apps/output/text/write_file.h"
#include "coupling/frame/atomic_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <unistd.h>

namespace gestell::apps
{
namespace fs = std::filesystem;
namespace
{

const char *const list_name = ".gestell-files";
const char *const list_head = "# Files that gestell wrote here: it replaces and removes no other files.";

std::error_code last_error()
{
  return {errno != 0 ? errno : EIO, std::generic_category()};
}

fs::file_type type_of(const fs::path &path)
{
  std::error_code none;
  return fs::symlink_status(path, none).type();
}

bool is_there(const fs::path &path)
{
  const fs::file_type type = type_of(path);
  return type != fs::file_type::not_found && type != fs::file_type::none;
}

/// Relative, below the folder: what a forged list may not leave.
bool stays_inside(const std::string &name)
{
  const fs::path path(name);
  return !name.empty() && path.is_relative() && name.find('\n') == std::string::npos &&
         std::none_of(path.begin(), path.end(), [](const fs::path &part) { return part == ".." || part == "."; });
}

/// Whether it is one of ours: none yet, begun by a process that was killed before its first line, or with our head.
bool is_own_list(const fs::path &list)
{
  if (!is_there(list))
    return true;
  std::ifstream in(list, std::ios::binary);
  std::string   line;
  return type_of(list) == fs::file_type::regular && (in.peek() == EOF || (std::getline(in, line) && line == list_head));
}

/// Its last line counts only if it ends.
std::set<std::string> names_of_list(const fs::path &list)
{
  std::set<std::string> names;
  std::ifstream         in(list, std::ios::binary);
  std::string           line;
  if (!is_own_list(list) || !std::getline(in, line))
    return names;
  while (std::getline(in, line) && !in.eof())
    if (stays_inside(line))
      names.insert(line);
  return names;
}

/// One write at the end of the file: processes side by side do not mix their lines.
void append(const fs::path &list, const std::string &name)
{
  std::error_code   none;
  const std::string text =
      (is_there(list) && fs::file_size(list, none) > 0 ? "" : list_head + std::string("\n")) + name + '\n';
  errno          = 0;
  const int file = open(list.c_str(), O_CREAT | O_WRONLY | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (file < 0)
    throw coupling::WriteFailure(list.string(), last_error());
  const off_t before  = lseek(file, 0, SEEK_END);
  const auto  written = ::write(file, text.data(), text.size());
  const auto  reason  = last_error();
  const bool  whole   = written == ssize_t(text.size());
  if (!whole && written > 0 && ftruncate(file, before) != 0) // an incomplete line is skipped when read
    errno = reason.value();
  if ((close(file) != 0 && whole) || !whole)
    throw coupling::WriteFailure(list.string(), whole ? last_error() : reason);
}

/// Names of a file in the folder, direct and through links; empty: it is elsewhere.
std::vector<std::string> names_of(const fs::path &file, const fs::path &folder)
{
  std::vector<std::string> names;
  std::error_code          error;
  const fs::path           own = fs::weakly_canonical(folder, error), whole = fs::absolute(file);
  for (const fs::path &path :
       {fs::weakly_canonical(whole.parent_path(), error) / whole.filename(), fs::weakly_canonical(whole, error)})
    if (const std::string name = path.lexically_relative(own).generic_string(); stays_inside(name))
      names.push_back(name);
  return names;
}

std::string in_words(const std::string &name, const fs::path &folder)
{
  return folder.string() + ": " + name;
}

} // namespace

bool has_form(const std::string &name, const std::string &pattern)
{
  const auto star = pattern.find('*');
  if (star == std::string::npos)
    return name == pattern;
  const std::string begin = pattern.substr(0, star), end = pattern.substr(star + 1);
  return name.size() >= begin.size() + end.size() && name.compare(0, begin.size(), begin) == 0 &&
         name.compare(name.size() - end.size(), end.size(), end) == 0 &&
         name.find('/', begin.size()) >= name.size() - end.size();
}

OwnFolder::OwnFolder(const fs::path &path) : path_(path), names_(names_of_list(path / list_name)) {}

bool OwnFolder::owns(const std::string &name) const
{
  return names_.count(name) > 0 && type_of(path_ / name) == fs::file_type::regular && obstacle(name).empty();
}

std::string OwnFolder::obstacle(const std::string &name) const
{
  fs::path inner;
  for (const fs::path &part : fs::path(name).parent_path())
  {
    inner /= part;
    const fs::file_type type = type_of(path_ / inner);
    if (type == fs::file_type::symlink)
      return inner.string() + " is a link, and results are not written through links; remove the link";
    if (is_there(path_ / inner) && type != fs::file_type::directory)
      return inner.string() + " is not a folder; move it";
  }
  const fs::path own = path_ / name;
  if (name.back() == '/' || !is_there(own))
    return "";
  if (type_of(own) == fs::file_type::directory)
    return name + " is a folder where a file is needed; move it";
  if (names_.count(name) == 0 || type_of(own) != fs::file_type::regular)
    return name + " was not written by gestell and would be overwritten; move it";
  return "";
}

void OwnFolder::require_free(const std::vector<std::string> &patterns, const std::vector<fs::path> &inputs) const
{
  const auto refuse = [&](const std::string &reason)
  {
    throw std::invalid_argument("result folder " + path_.string() + ": " + reason +
                                ", or name another folder with -o DIR.");
  };
  require_own_list();
  std::error_code none;
  for (const std::string &pattern : patterns)
  {
    if (pattern.empty())
      continue;
    const fs::path inner = path_ / fs::path(pattern).parent_path();
    const auto     judge = [&](const std::string &name)
    {
      if (const std::string reason = obstacle(name); !reason.empty())
        refuse(reason);
    };
    judge(pattern);
    if (pattern.find('*') != std::string::npos && type_of(inner) == fs::file_type::directory)
      for (const auto &entry : fs::directory_iterator(inner, none))
        if (const std::string name = entry.path().lexically_relative(path_).generic_string(); has_form(name, pattern))
          judge(name);
  }
  for (const fs::path &input : inputs)
    for (const std::string &name : names_of(input, path_))
      if (std::any_of(patterns.begin(), patterns.end(),
                      [&](const std::string &pattern) { return has_form(name, pattern); }))
        refuse(name + " is an input of this command and would be overwritten; copy it to another folder");
}

bool OwnFolder::is_any_of(const std::string &name, const std::vector<fs::path> &inputs) const
{
  return std::any_of(inputs.begin(), inputs.end(),
                     [&](const fs::path &input)
                     {
                       const auto names = names_of(input, path_);
                       return std::count(names.begin(), names.end(), name) > 0;
                     });
}

void OwnFolder::require_own_list() const
{
  if (!is_own_list(path_ / list_name))
    throw std::invalid_argument("result folder " + path_.string() + ": " + list_name +
                                " is not a file list written by gestell; move it, or name another folder with -o DIR.");
}

void OwnFolder::enter(const std::string &name)
{
  if (!stays_inside(name))
    throw std::invalid_argument(in_words(name, path_) + ": not the name of a file inside the folder");
  if (names_.count(name) > 0)
    return;
  require_own_list();
  append(path_ / list_name, name);
  names_.insert(name);
}

fs::path OwnFolder::claim(const std::string &name)
{
  if (const std::string reason = obstacle(name); !reason.empty())
    throw std::invalid_argument("result folder " + path_.string() + ": " + reason + ".");
  const fs::path  place = path_ / name;
  std::error_code error;
  fs::create_directories(place.parent_path(), error);
  if (error)
    throw coupling::WriteFailure(place.string(), error);
  remove_abandoned(fs::path(name).parent_path().generic_string());
  enter(name);
  return place;
}

void OwnFolder::adopt(const std::string &name)
{
  enter(name);
}

void OwnFolder::write(const std::string &name, const std::string &content)
{
  write_file(claim(name), content);
}

void OwnFolder::remove(const std::string &name)
{
  if (owns(name))
    fs::remove(path_ / name);
}

void OwnFolder::remove_abandoned(const std::string &inner)
{
  if (cleared_.insert(inner).second && (inner.empty() || type_of(path_ / inner) == fs::file_type::directory))
    coupling::remove_abandoned((path_ / inner).string());
}

void OwnFolder::keep_list(const std::set<std::string> &names)
{
  if (names == names_)
    return;
  std::string text = list_head + std::string("\n");
  for (const std::string &name : names)
    text += name + '\n';
  try
  {
    write_file(path_ / list_name, text);
    names_ = names;
  }
  catch (const coupling::WriteFailure &) // the old list is valid too: it also names deleted files
  {
  }
}

void OwnFolder::remove_all(const std::function<bool(const std::string &)> &goes)
{
  std::set<std::string> kept, folders = {""};
  for (const std::string &name : names_)
  {
    folders.insert(fs::path(name).parent_path().generic_string());
    const bool own = owns(name);
    if (own && goes(name))
      fs::remove(path_ / name);
    else if (own)
      kept.insert(name);
  }
  for (const std::string &inner : folders)
  {
    std::error_code none;
    if (!obstacle(inner.empty() ? "x" : inner + "/x").empty() && !inner.empty())
      continue;
    remove_abandoned(inner);
    if (!inner.empty() && fs::is_directory(path_ / inner, none) && fs::is_empty(path_ / inner, none))
      fs::remove(path_ / inner, none);
  }
  keep_list(kept);
}

std::error_code probe(const fs::path &folder)
{
  std::error_code error;
  fs::path        there = fs::absolute(folder).lexically_normal();
  while (!fs::exists(there, error) && !error && there.has_relative_path())
    there = there.parent_path();
  if (error) // a name too long, a ring of links, a folder that may not be entered
    return error;
  if (!fs::is_directory(there, error))
    return std::make_error_code(fs::exists(there, error) ? std::errc::not_a_directory
                                                         : std::errc::no_such_file_or_directory); // went meanwhile
  const coupling::FileBeside file((there / "probe").string());
  errno = 0;
  if (std::ofstream(file.place()) << "probe" << std::flush)
    return {};
  return last_error();
}

} // namespace gestell::apps

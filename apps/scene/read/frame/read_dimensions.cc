#include "apps/scene/read/frame/read_dimensions.h"

#include "coupling/frame/atomic_file.h"
#include "coupling/frame/cache_folder.h"
#include "coupling/frame/sha256.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"
#include "fem/values/temporary_directory.h"

#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

namespace fs = std::filesystem;

/// `NAME = ...;` at the start of a line: its name and the places of its value.
struct Assignment
{
  std::string name;
  std::size_t value = 0, end = 0; ///< places in the script
};

/// The assignment that begins at `at`, with an empty name if none does.
Assignment assignment_at(const std::string &script, std::size_t at)
{
  const auto blank = [&](std::size_t i) { return i < script.size() && (script[i] == ' ' || script[i] == '\t'); };
  while (blank(at))
    ++at;
  std::size_t end = at;
  while (end < script.size() && (std::isalnum(static_cast<unsigned char>(script[end])) || script[end] == '_'))
    ++end;
  Assignment found{script.substr(at, end - at)};
  while (blank(end))
    ++end;
  if (end >= script.size() || script[end] != '=' || (end + 1 < script.size() && script[end + 1] == '='))
    return {};
  found.value = end + 1;
  found.end   = script.find(';', end);
  return found.end == std::string::npos ? Assignment{} : found;
}

std::vector<Assignment> assignments_of(const std::string &script)
{
  std::vector<Assignment> all;
  for (std::size_t at = 0; at < script.size(); at = std::min(script.find('\n', at), script.size() - 1) + 1)
    if (Assignment found = assignment_at(script, at); !found.name.empty())
      all.push_back(std::move(found));
  return all;
}

/// Value of a dimension in the unit of the script.
double in_script(const SceneTable &dimensions, const std::string &name, double unit)
{
  const Quantity quantity = dimensions.quantity(name);
  if (equal(quantity.dimension, {}))
    return quantity.value;
  if (equal(quantity.dimension, kind::length.dimension))
    return quantity.value / (unit > 0. ? unit : 1.);
  throw dimensions.error(name, "needs a length such as \"70 mm\" or a plain number, got one in " +
                                   describe(quantity.dimension));
}

void write_in(std::string &script, const SceneTable &dimensions, const std::string &name, double value)
{
  std::vector<std::string> names;
  for (const Assignment &assignment : assignments_of(script))
  {
    if (assignment.name == name)
    {
      script.replace(assignment.value, assignment.end - assignment.value, ' ' + exact_text(value));
      return;
    }
    names.push_back(assignment.name);
  }
  throw dimensions.error(name, "the script has no line '" + name + " = ...;'" + suggestion(name, names));
}

bool holds(const fs::path &file, const std::string &text)
{
  std::ifstream      in(file, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return in && content.str() == text;
}

/// Temporary folder of this process, deleted at its end; used if there is no cache folder or it cannot be written to.
const fs::path &own_folder()
{
  static const fem::TemporaryDirectory folder;
  return folder.path();
}

/// Written once, whole or not at all: other processes may want the same.
std::string kept(const std::string &script, const std::string &stem)
{
  const std::string name    = stem + '_' + coupling::Sha256().update(script).hexadecimal().substr(0, 16) + ".geo";
  const fs::path    cache   = coupling::cache_folder();
  const fs::path    folder  = cache / "geometry";
  const auto        written = [&](const fs::path &file)
  {
    fs::create_directories(file.parent_path());
    coupling::AtomicFile out(file.string());
    out.stream() << script;
    out.finish();
    return file.string();
  };
  if (!cache.empty() && coupling::foreign(cache.string()).empty() && coupling::foreign(folder.string()).empty())
    try
    {
      const fs::path file = folder / name;
      return holds(file, script) ? file.string() : written(file);
    }
    catch (const std::exception &) // the cache is for reading only
    {
    }
  return written(own_folder() / name);
}

} // namespace

std::string with_dimensions(const SceneTable &frame, const std::string &cad, double unit)
{
  const auto dimensions = frame.optional_table("dimensions");
  if (!dimensions || dimensions->keys().empty())
    return cad;
  const std::filesystem::path path(cad);
  if (path.extension() != ".geo")
    throw frame.error("dimensions", "are those of a script (.geo), but cad is " + path.filename().string());
  std::ifstream      in(path);
  std::ostringstream text;
  text << in.rdbuf();
  std::string script = text.str();
  for (const char *word : {"Include ", "Merge ", "ShapeFromFile"})
    if (script.find(word) != std::string::npos)
      throw frame.error("dimensions", path.filename().string() + " reads other files (" +
                                          std::string(word, std::strcspn(word, " ")) + "); write them into the script");
  for (const std::string &name : dimensions->keys())
    write_in(script, *dimensions, name, in_script(*dimensions, name, unit));
  return kept(script, path.stem().string());
}

} // namespace gestell::apps

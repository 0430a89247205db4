#include "coupling/plugin/plugin.h"

#include <dlfcn.h>

#include <cstdlib>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace fs = std::filesystem;

namespace
{

/// The file that this code was loaded from: the program, or the library of whoever computes without it.
fs::path own_file()
{
  std::error_code ignored;
  Dl_info         own{};
  const bool      known = dladdr(reinterpret_cast<const void *>(&find_plugin), &own) != 0 && own.dli_fname;
  const fs::path  named = known ? fs::canonical(own.dli_fname, ignored) : fs::path();
  return named.empty() ? fs::read_symlink("/proc/self/exe", ignored) : named;
}

bool has_file(const fs::path &file)
{
  std::error_code ignored;
  return fs::exists(file, ignored);
}

/// The plugin: in a build, in the folder of the file; installed, in lib/gestell of the prefix above the file.
fs::path plugin_of(const fs::path &file, const char *library)
{
  fs::path folder = file.parent_path();
  if (has_file(folder / library))
    return folder / library;
  constexpr int most_levels = 4; // of lib/python3/dist-packages/gestell.so below the prefix
  for (int level = 0; level < most_levels; ++level, folder = folder.parent_path())
    if (const fs::path installed = folder / "lib" / "gestell" / library; has_file(installed))
      return installed;
  return {};
}

std::mutex loaded_changes;

/// Names of the files of plugins that this process has loaded.
std::set<std::string> &loaded()
{
  static std::set<std::string> names;
  return names;
}

} // namespace

fs::path find_plugin(const char *library)
{
  std::error_code ignored;
  for (const fs::path &file : {own_file(), fs::read_symlink("/proc/self/exe", ignored)})
    if (const fs::path found = plugin_of(file, library); !found.empty())
      return found;
  const char *folder = std::getenv("GESTELL_PLUGIN_DIR");
  return folder && has_file(fs::path(folder) / library) ? fs::path(folder) / library : fs::path();
}

void *load_plugin(const fs::path &file)
{
  void *handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle)
    throw std::invalid_argument("plugin: " + file.string() + " cannot be loaded: " + dlerror() +
                                "; install the libraries it names");
  const std::lock_guard<std::mutex> alone(loaded_changes);
  loaded().insert(file.filename().string());
  return handle;
}

bool plugin_is_loaded(const char *library)
{
  const std::lock_guard<std::mutex> alone(loaded_changes);
  return loaded().count(library) > 0;
}

void *function_of_plugin(void *plugin, const char *name, const char *library)
{
  void *const function = dlsym(plugin, name);
  if (!function)
    throw std::invalid_argument(std::string("plugin: ") + library + " is not a Gestell plugin: " + dlerror() +
                                "; rebuild it together with the program");
  return function;
}

} // namespace gestell::coupling

#include "coupling/plugin/plugin.h"

#include <dlfcn.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace gestell::coupling
{

namespace fs = std::filesystem;

fs::path find_plugin(const char *library)
{
  std::error_code ignored;
  const fs::path  beside = fs::read_symlink("/proc/self/exe", ignored).parent_path() / library;
  if (fs::exists(beside, ignored))
    return beside;
  const char *folder = std::getenv("GESTELL_PLUGIN_DIR");
  return folder && fs::exists(fs::path(folder) / library, ignored) ? fs::path(folder) / library : fs::path();
}

void *load_plugin(const fs::path &file)
{
  void *handle = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!handle)
    throw std::invalid_argument("plugin: " + file.string() + " cannot be loaded: " + dlerror() +
                                "; install the libraries it names");
  return handle;
}

void *function_of_plugin(void *plugin, const char *name, const char *library)
{
  void *const function = dlsym(plugin, name);
  if (!function)
    throw std::invalid_argument(std::string("plugin: ") + library + " is not a plugin of Gestell: " + dlerror() +
                                "; rebuild it together with the program");
  return function;
}

} // namespace gestell::coupling

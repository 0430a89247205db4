#pragma once

#include <filesystem>

namespace gestell::coupling
{

/// Path of a plugin: in the folder of the program, or of the library in its place; else in lib/gestell of the
/// installation prefix; else in the folder in the environment variable GESTELL_PLUGIN_DIR; empty if there is none.
std::filesystem::path find_plugin(const char *library);

/// Loads it; it is never unloaded.  @throws std::invalid_argument with the loader's reason.
void *load_plugin(const std::filesystem::path &file);

/// Whether this process has loaded it.
bool plugin_is_loaded(const char *library);

/// The function of this name in a loaded plugin.  @throws std::invalid_argument if there is none.
void *function_of_plugin(void *plugin, const char *name, const char *library);

} // namespace gestell::coupling

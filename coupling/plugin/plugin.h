#pragma once

#include <filesystem>

namespace gestell::coupling
{

/// The file of a plugin: in the folder of the program, or of the library that computes in its place; else in
/// lib/gestell of the prefix where that is installed; else in the folder that the environment variable
/// GESTELL_PLUGIN_DIR names; empty if there is none.
std::filesystem::path find_plugin(const char *library);

/// Loads it, never to be unloaded.  @throws std::invalid_argument with the loader's reason.
void *load_plugin(const std::filesystem::path &file);

/// Whether this process has loaded it.
bool plugin_is_loaded(const char *library);

/// The function of this name in a loaded plugin.  @throws std::invalid_argument if there is none.
void *function_of_plugin(void *plugin, const char *name, const char *library);

} // namespace gestell::coupling

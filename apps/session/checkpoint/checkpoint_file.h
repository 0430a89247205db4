#pragma once

#include "apps/session/checkpoint/run_key.h"

#include <filesystem>

namespace gestell::apps
{

/// Writes the state of a run whole or not at all; its folder is made.
/// @throws std::runtime_error if it cannot be written (disk full)
void write_checkpoint(const std::filesystem::path &file, const std::vector<KeyPart> &key, const std::string &state);

/// The state that stands there, of the run of this key.
/// @throws std::invalid_argument if there is none, if it is damaged or if it is that of another run, and tells what of
/// the key differs
std::string read_checkpoint(const std::filesystem::path &file, const std::vector<KeyPart> &key);

} // namespace gestell::apps

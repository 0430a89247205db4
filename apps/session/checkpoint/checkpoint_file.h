#pragma once

#include "apps/session/checkpoint/run_key.h"

#include <filesystem>

namespace gestell::apps
{

/// Writes the state of a run atomically, and makes its folder.
/// @throws std::runtime_error if it cannot be written (disk full)
void write_checkpoint(const std::filesystem::path &file, const std::vector<KeyPart> &key, const std::string &state);

std::string checkpoint_text(const std::vector<KeyPart> &key, const std::string &state); ///< content of such a file

/// Returns the state in the file, if it belongs to the run with this key.
/// @throws std::invalid_argument if there is no file, if it is damaged or if it is from another run, with the parts of
///   the key that differ
/// @param reader, remedy  how the message begins and ends
std::string read_checkpoint(const std::filesystem::path &file, const std::vector<KeyPart> &key,
                            const std::string &reader = "--resume",
                            const std::string &remedy = "start it again without --resume");

} // namespace gestell::apps

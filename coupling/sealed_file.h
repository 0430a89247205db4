#pragma once

#include <string>

namespace gestell::coupling
{

/// Writes a head of 512 bytes, with title and SHA-256 of the content, and then the content.  (HDF5 finds its own behind
/// it.)
/// @throws std::runtime_error if that fails.
void write_sealed(const std::string &file, const std::string &title, const std::string &content);

/// Whether a file is what it was when it was sealed under this title: "" if so, else the reason why it is not to be
/// trusted.
std::string seal_defect(const std::string &file, const std::string &title);

} // namespace gestell::coupling

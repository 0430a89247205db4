#pragma once

#include <string>

namespace gestell::coupling
{

/// Writes a header of 512 bytes, with title and SHA-256 of the content, and then the content. (HDF5 skips such a
/// header.)
/// @throws std::runtime_error if that fails.
void write_sealed(const std::string &file, const std::string &title, const std::string &content);

/// Whether a file begins with a header of this title: "" if so, else the reason. Reads the header only and does not
/// detect damage of the content.
std::string head_defect(const std::string &file, const std::string &title);

/// Whether a file is unchanged since it was written under this title: "" if so, else the reason.
std::string seal_defect(const std::string &file, const std::string &title);

} // namespace gestell::coupling

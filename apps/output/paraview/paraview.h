#pragma once

#include "apps/output/values/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/**
 * Writes frame_modes.pvd (one data set per mode shape) and motion.pvd (frame and mechanism at every saved instant)
 * with the folders of .vtp files they name.
 *
 * Point fields: `displacement [m]`, true to scale.  In frame_modes it is the mode shape scaled to a largest
 * displacement of a twentieth of the frame's size; the time of a data set is the number of the mode, whose frequency
 * is the field `frequency [Hz]`.
 *
 * @param names gets the names of the written files, relative to the folder.
 * @return      warnings: what could not be written, and why.
 * @throws std::runtime_error if a file cannot be written.
 */
std::vector<std::string> write_paraview(const std::filesystem::path &folder, const Result &result,
                                        std::vector<std::string> &names);

} // namespace gestell::apps

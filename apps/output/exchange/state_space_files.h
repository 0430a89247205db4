#pragma once

#include "apps/output/values/state_space_model.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/// "mat" (version 5; not in builds without libmatio), "matrix-market".
const std::vector<std::string> &exchange_formats();

/**
 * Writes a linear machine into a folder that is there: state_space.mat with A, B, C, D, Z and names, or
 * state_space_A.mtx ... with state_space.csv, which names states, inputs and outputs.
 *
 * @return names of the files
 * @throws std::invalid_argument for another format, std::runtime_error if a file cannot be written
 */
std::vector<std::string> write_state_space(const std::filesystem::path &folder, const StateSpaceModel &model,
                                           const std::string &format);

} // namespace gestell::apps

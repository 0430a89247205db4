#pragma once

#include "apps/output/folder/own_folder.h"
#include "apps/output/values/state_space_model.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// "mat" (version 5; not in builds without libmatio), "matrix-market".
const std::vector<std::string> &exchange_formats();

/// Names of the files of a format, '*' for any letters.
std::vector<std::string> state_space_files(const std::string &format);

/**
 * Writes a linear machine into a folder: state_space.mat with A, B, C, D, Z and names, or
 * state_space_A.mtx ... with state_space.csv, which names states, inputs and outputs.
 *
 * @return names of the files
 * @throws std::invalid_argument for another format, coupling::WriteFailure if a file cannot be written
 */
std::vector<std::string> write_state_space(OwnFolder &folder, const StateSpaceModel &model, const std::string &format);

} // namespace gestell::apps

#pragma once

#include "apps/output/folder/own_folder.h"
#include "apps/output/values/result.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// names.pvd with one data set for each saved instant: a point in the middle of each body, with its name as text.
void write_name_files(OwnFolder &folder, const Result &result, const std::vector<std::size_t> &pictures,
                      std::vector<std::string> &names);

} // namespace gestell::apps

#pragma once

#include "apps/verify/reference_case.h"

namespace gestell::apps
{

/// @throws std::invalid_argument with file and line
CaseFile read_cases(const std::string &path);

/// Files of cases in a folder, by name.
/// @throws std::invalid_argument if there are none
std::vector<std::string> case_files(const std::string &folder);

/// The folder of cases that is installed with the program, next to it or in its share folder.
/// @throws std::invalid_argument if it does not exist
std::string shipped_cases();

} // namespace gestell::apps

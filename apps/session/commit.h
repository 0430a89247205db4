#pragma once

#include <string>

namespace gestell::apps
{

/// The commit that this program was built from, "7c48666a1b2c", with "-dirty" if sources differed from it; empty if it
/// was built without a repository.
std::string commit();

} // namespace gestell::apps

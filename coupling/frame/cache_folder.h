#pragma once

#include <string>

namespace gestell::coupling
{

/// $GESTELL_CACHE, else $XDG_CACHE_HOME/gestell, else .cache/gestell in $HOME, or in the home folder from the user
/// database; "": none of them exists, so there is no cache.
std::string cache_folder();

/// Why another user may have written this file or folder: "belongs to another user (uid 1001)".  "": none, or it does
/// not exist. This user and root are trusted; others may write into a sticky folder (/tmp).
std::string foreign(const std::string &path);

} // namespace gestell::coupling

#pragma once

#include <string>

namespace gestell::coupling
{

/// $GESTELL_CACHE, else $XDG_CACHE_HOME/gestell, else .cache/gestell in $HOME, or in the home that the system knows of
/// this user; "": none of them, and nothing is kept.
std::string cache_folder();

/// Why another user may have written this file or folder: "belongs to another user (uid 1001)".  "": none can have, or
/// it is not there.  Trusted are this user and root; others may write into a folder where each keeps their own (/tmp).
std::string foreign(const std::string &path);

} // namespace gestell::coupling

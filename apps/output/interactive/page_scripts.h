#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// A library that is embedded in pages; it is compiled into the program.
struct PageLibrary
{
  std::string name, version, source; ///< source: its origin
};

/// Libraries of this build; empty: pages show pictures only.
std::vector<PageLibrary> page_libraries();

/// Style and scripts for the end of a page with live charts, a view of the machine, or both: libraries with their
/// licence, then our own.  Empty for a page with neither, or if this build has no libraries.
std::string page_scripts(bool charts, bool machine);

} // namespace gestell::apps

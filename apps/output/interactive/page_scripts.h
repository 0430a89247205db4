#pragma once

#include <string>
#include <vector>

namespace gestell::apps
{

/// A library that pages carry; it is compiled into the program.
struct PageLibrary
{
  std::string name, version, source; ///< source: where it is kept
};

/// Those this build has; empty: pages show pictures only.
std::vector<PageLibrary> page_libraries();

/// Style and scripts at the end of a page with live charts, with a view of the machine, or both: libraries with their
/// licence, then our own.  Empty without either, or if this build has no libraries.
std::string page_scripts(bool charts, bool machine);

} // namespace gestell::apps

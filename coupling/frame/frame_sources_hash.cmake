# Writes the header that distinguishes programs that make different frames: SHA-256 over the sources that make them, and over
# headers that state the versions of libraries, so that nobody has to raise a number.  Called with SOURCES, HEADER (to write).
set(all "")
foreach(source IN LISTS SOURCES)
  file(SHA256 "${source}" hash)
  string(APPEND all "${hash};")
endforeach()
string(SHA256 frame_sources_hash "${all}")
file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT [[
#pragma once

namespace gestell::coupling
{

/// SHA-256 over the sources that make frames and the versions of their libraries.
constexpr const char *frame_sources_hash = "@frame_sources_hash@";

} // namespace gestell::coupling
]])

# Writes the header that tells apart programs that make different frames: SHA-256 over the sources that make them, so that
# nobody has to remember to raise a number.  Called with SOURCE (top folder), HEADER (to write).
include("${CMAKE_CURRENT_LIST_DIR}/frame_sources.cmake")
frame_sources("${SOURCE}" sources)
set(all "")
foreach(source IN LISTS sources)
  file(SHA256 "${source}" hash)
  string(APPEND all "${hash};")
endforeach()
string(SHA256 frame_sources_hash "${all}")
file(CONFIGURE OUTPUT "${HEADER}" @ONLY CONTENT [[
#pragma once

namespace gestell::coupling
{

/// SHA-256 over the sources that make frames.
constexpr const char *frame_sources_hash = "@frame_sources_hash@";

} // namespace gestell::coupling
]])

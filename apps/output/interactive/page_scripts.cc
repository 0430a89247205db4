#include "apps/output/interactive/page_scripts.h"

#define GESTELL_EMBEDDED_FILE(name) extern "C" const char gestell_##name##_begin[], gestell_##name##_end[];
GESTELL_EMBEDDED_FILE(dygraphs)
GESTELL_EMBEDDED_FILE(dygraphs_style)
GESTELL_EMBEDDED_FILE(synchronizer)
GESTELL_EMBEDDED_FILE(three)
GESTELL_EMBEDDED_FILE(orbit_controls)
GESTELL_EMBEDDED_FILE(page_script)
GESTELL_EMBEDDED_FILE(chart_script)
GESTELL_EMBEDDED_FILE(machine_script)
GESTELL_EMBEDDED_FILE(picture_script)
GESTELL_EMBEDDED_FILE(page_style)
GESTELL_EMBEDDED_FILE(licence)
#undef GESTELL_EMBEDDED_FILE

namespace gestell::apps
{
namespace
{

#define GESTELL_TEXT(name) std::string(gestell_##name##_begin, gestell_##name##_end)

std::string script(const std::string &text)
{
  return "<script>" + text + "</script>\n";
}

/// Adds the licence of the libraries, which requires this.
std::string library(const std::string &name, const std::string &owner, const std::string &text)
{
  return script("/*! " + name + ", " + owner + "\n" + GESTELL_TEXT(licence) + "*/\n" + text);
}

} // namespace

std::vector<PageLibrary> page_libraries()
{
  const std::string dygraphs = GESTELL_DYGRAPHS_VERSION, three = GESTELL_THREE_VERSION;
  if (dygraphs.empty() || three.empty())
    return {};
  return {{"dygraphs", dygraphs, "Debian package libjs-dygraphs"}, {"three.js", three, "Debian package libjs-three"}};
}

std::string page_scripts(bool charts, bool machine)
{
  if (page_libraries().empty() || !(charts || machine))
    return "";
  std::string html = "<style>" + (charts ? GESTELL_TEXT(dygraphs_style) : "") + GESTELL_TEXT(page_style) +
                     "</style>\n" + script(GESTELL_TEXT(page_script));
  if (charts)
    html += library("dygraphs " GESTELL_DYGRAPHS_VERSION, "copyright 2006-2023 Dan Vanderkam and contributors",
                    GESTELL_TEXT(dygraphs) + "\n" + GESTELL_TEXT(synchronizer)) +
            script(GESTELL_TEXT(chart_script));
  if (machine)
    html += library("three.js " GESTELL_THREE_VERSION, "copyright 2010-2019 three.js authors",
                    GESTELL_TEXT(three) + "\n" + GESTELL_TEXT(orbit_controls)) +
            script(GESTELL_TEXT(machine_script)) + script(GESTELL_TEXT(picture_script));
  return html;
}

#undef GESTELL_TEXT

} // namespace gestell::apps

#pragma once

namespace gestell::apps
{

/// Script that rotates the view and picks faces, from their table `frame`.
extern const char *const faces_script;
extern const char *const faces_style;

} // namespace gestell::apps

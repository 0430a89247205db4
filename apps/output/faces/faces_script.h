#pragma once

namespace gestell::apps
{

/// What turns and picks the faces of the page from their table, `frame`.
extern const char *const faces_script;
extern const char *const faces_style;

} // namespace gestell::apps

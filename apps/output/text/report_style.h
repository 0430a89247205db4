#pragma once

namespace gestell::apps
{

/// Style sheet of the report: light or dark as the reader has chosen, white on paper.
extern const char *const report_style;

} // namespace gestell::apps

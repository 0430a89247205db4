#pragma once

namespace gestell::apps
{

/// Script that draws chart.html from its table of runs, `work`.
extern const char *const work_precision_script;
extern const char *const work_precision_style;

} // namespace gestell::apps

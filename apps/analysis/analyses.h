#pragma once

#include "apps/analysis/analysis.h"

#include <optional>

namespace gestell::apps
{

/// All of them, in the order of reports.
const std::vector<AnalysisEntry> &analyses();

/// @throws std::invalid_argument with the nearest name
const AnalysisEntry &analysis_named(const std::string &name);

/// What it finds of the session's scene.
Result computed(const AnalysisEntry &entry, Analysis &analysis, Session &session);

/// Those that add to the result of a command.
using Analyses = std::vector<std::shared_ptr<Analysis>>;
Analyses                 analyses_of(const std::string &command);
void                     add_options(const Analyses &analyses, std::vector<CommandOption> &options);
std::vector<std::string> files_read_by(const Analyses &analyses);
void                     check_all(const Analyses &analyses, Session &session); ///< of those requested

/// Of those requested; @return whether all have an answer
bool add_answers(const Analyses &analyses, Session &session, Result &result);

/// A run with the answers that every run has, such as its spectra.
Result complete_run(Session &session, const std::optional<std::string> &sensitivities = {});

/// A result with an answer of each, for the lists of what summary.json may hold.
Result result_of_all_kinds();

} // namespace gestell::apps

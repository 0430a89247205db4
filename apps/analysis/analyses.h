#pragma once

#include "apps/analysis/analysis.h"

#include <map>

namespace gestell::apps
{

/// All analyses, in the order of reports.
const std::vector<AnalysisEntry> &analyses();

/// @throws std::invalid_argument with the most similar name
const AnalysisEntry &analysis_named(const std::string &name);

/// Result of an analysis, after its check(), of the session's scene, or of its run if the analysis adds to runs.  If
/// such a run fails or is interrupted, so does the analysis.
Result computed(const AnalysisEntry &entry, Analysis &analysis, Session &session, AnalysisOutcome &outcome);

/// Values by option names, as typed: {"--sensitivities", {"all"}}.
using OptionTexts = std::map<std::string, std::vector<std::string>>;
void set_options(Analysis &analysis, const OptionTexts &options);

/// Analyses that add to the result of a command.
using Analyses = std::vector<std::shared_ptr<Analysis>>;
Analyses                 analyses_of(const std::string &command, const OptionTexts &options = {});
void                     add_options(const Analyses &analyses, std::vector<CommandOption> &options);
std::vector<std::string> files_read_by(const Analyses &analyses);
void                     check_all(const Analyses &analyses, Session &session); ///< checks those that are requested
/// The option of a requested analysis that needs the trajectory, see RunPart; empty: none.
std::string needs_trajectory(const Analyses &analyses, const Scene &scene);

/// A run with the requested analyses that take part in it, such as its stages; these may fail.  Checks them first.
Result run_with(const Analyses &analyses, Session &session);
/// Reason why a computation failed: that of its run, or else its last warning.
std::string failure_of(const Result &result);
/// Adds the answers of the requested analyses; @return the worst outcome
AnalysisOutcome add_answers(const Analyses &analyses, Session &session, Result &result);
/// run_with() and add_answers(): a run with the answers that every run has, such as its spectra.
Result complete_run(Session &session, const Analyses &analyses = analyses_of("run"));

/// A result with an empty answer of each analysis, for the list of members of summary.json.
Result result_of_all_kinds();

} // namespace gestell::apps

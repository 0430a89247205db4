#pragma once

#include "apps/analysis/analysis.h"

#include <map>

namespace gestell::apps
{

/// All of them, in the order of reports.
const std::vector<AnalysisEntry> &analyses();

/// @throws std::invalid_argument with the nearest name
const AnalysisEntry &analysis_named(const std::string &name);

/// What it finds of the session's scene, of its run where it adds to runs.  Such a run may fail or be interrupted, and
/// then so does the analysis.
Result computed(const AnalysisEntry &entry, Analysis &analysis, Session &session, AnalysisOutcome &outcome);

/// By the names of options, as they are typed: {"--sensitivities", {"all"}}.
using OptionTexts = std::map<std::string, std::vector<std::string>>;
void set_options(Analysis &analysis, const OptionTexts &options);

/// Those that add to the result of a command.
using Analyses = std::vector<std::shared_ptr<Analysis>>;
Analyses                 analyses_of(const std::string &command, const OptionTexts &options = {});
void                     add_options(const Analyses &analyses, std::vector<CommandOption> &options);
std::vector<std::string> files_read_by(const Analyses &analyses);
void                     check_all(const Analyses &analyses, Session &session); ///< of those requested
/// The option of one of those requested, see RunPart; empty: none.
std::string needs_trajectory(const Analyses &analyses, const Scene &scene);

/// A run, and what those requested find while it is made, such as its stages, which may fail it.  Checks them before.
Result run_with(const Analyses &analyses, Session &session);
/// Why a computation failed: the reason of its run, else its last warning.
std::string failure_of(const Result &result);
/// Of those requested; @return the worst
AnalysisOutcome add_answers(const Analyses &analyses, Session &session, Result &result);
/// Both: a run with the answers that every run has, such as its spectra.
Result complete_run(Session &session, const Analyses &analyses = analyses_of("run"));

/// A result with an answer of each, for the lists of what summary.json may hold.
Result result_of_all_kinds();

} // namespace gestell::apps

#include "apps/analysis/analyses.h"

#include "fem/values/nearest_name.h"

#include <algorithm>

namespace gestell::apps
{

AnalysisEntry periodic_analysis(), along_analysis(), sensitivity_analysis(), stage_analysis(), compare_run_analysis(),
    budget_analysis(), spectra_analysis(), frf_analysis(), compare_modes_analysis(), damping_for_analysis(),
    life_analysis();

const std::vector<AnalysisEntry> &analyses()
{
  static const std::vector<AnalysisEntry> all = {
      periodic_analysis(),      along_analysis(),       sensitivity_analysis(), stage_analysis(),
      compare_run_analysis(),   budget_analysis(),      spectra_analysis(),     frf_analysis(),
      compare_modes_analysis(), damping_for_analysis(), life_analysis()};
  return all;
}

const AnalysisEntry &analysis_named(const std::string &name)
{
  std::vector<std::string> names;
  for (const AnalysisEntry &entry : analyses())
    if (entry.is_command())
      if (names.push_back(entry.name); entry.name == name)
        return entry;
  throw std::invalid_argument("there is no analysis '" + name + "'" + suggestion(name, names));
}

void set_options(Analysis &analysis, const OptionTexts &options)
{
  for (const CommandOption &option : analysis.options())
    if (const auto given = options.find(option.name); given != options.end())
      option.set(given->second);
}

Analyses analyses_of(const std::string &command, const OptionTexts &options)
{
  Analyses own;
  for (const AnalysisEntry &entry : analyses())
    if (entry.of == command)
      set_options(*own.emplace_back(entry.begin()), options);
  return own;
}

void add_options(const Analyses &analyses, std::vector<CommandOption> &options)
{
  for (const auto &analysis : analyses)
    for (const CommandOption &option : analysis->options())
      options.push_back(option);
}

std::vector<std::string> files_read_by(const Analyses &analyses)
{
  std::vector<std::string> files;
  for (const auto &analysis : analyses)
    for (const std::string &file : analysis->reads())
      files.push_back(file);
  return files;
}

namespace
{

Analyses requested_of(const Analyses &analyses, const Scene &scene)
{
  Analyses own;
  for (const auto &analysis : analyses)
    if (analysis->requested(scene))
      own.push_back(analysis);
  return own;
}

} // namespace

void check_all(const Analyses &analyses, Session &session)
{
  for (const auto &analysis : requested_of(analyses, session.scene()))
    analysis->check(session);
}

std::string needs_trajectory(const Analyses &analyses, const Scene &scene)
{
  std::string option;
  for (const auto &analysis : requested_of(analyses, scene))
    option += option.empty() ? analysis->needs_trajectory() : "";
  return option;
}

Result computed(const AnalysisEntry &entry, Analysis &analysis, Session &session, AnalysisOutcome &outcome)
{
  const auto add = [&](Result &result) { outcome = analysis.compute(session, result); };
  if (entry.of != "run" || !analysis.computes_run())
    return session.answered(entry.name, add);
  const Analyses parts = analyses_of("run"); // those that tables of the scene request
  RunParts       all;
  for (const auto &part : requested_of(parts, session.scene()))
    all.push_back(part.get());
  all.push_back(&analysis);
  Result result  = session.run(all);
  result.command = entry.name;
  add(result);
  if (!result.run->failure.empty())
    outcome = AnalysisOutcome::failed;
  else if (result.run->interrupted)
    outcome = std::max(outcome, AnalysisOutcome::interrupted);
  return result;
}

std::string failure_of(const Result &result)
{
  if (result.run && !result.run->failure.empty())
    return result.run->failure;
  return result.warnings.empty() ? "without a reason" : result.warnings.back();
}

Result run_with(const Analyses &analyses, Session &session)
{
  check_all(analyses, session);
  RunParts parts;
  for (const auto &analysis : requested_of(analyses, session.scene()))
    parts.push_back(analysis.get());
  return session.run(parts);
}

AnalysisOutcome add_answers(const Analyses &analyses, Session &session, Result &result)
{
  AnalysisOutcome worst = AnalysisOutcome::done;
  for (const auto &analysis : requested_of(analyses, session.scene()))
    worst = std::max(worst, analysis->compute(session, result));
  return worst;
}

Result complete_run(Session &session, const Analyses &analyses)
{
  Result result = run_with(analyses, session);
  add_answers(analyses, session, result);
  return result;
}

Result result_of_all_kinds()
{
  Result all;
  for (const AnalysisEntry &entry : analyses())
    all.answers.push_back(entry.nothing());
  return all;
}

} // namespace gestell::apps

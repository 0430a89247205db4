#include "apps/analysis/analyses.h"

#include "fem/values/nearest_name.h"

namespace gestell::apps
{

AnalysisEntry compare_run_analysis(), budget_analysis(), spectra_analysis(), frf_analysis(), compare_modes_analysis();

const std::vector<AnalysisEntry> &analyses()
{
  static const std::vector<AnalysisEntry> all = {compare_run_analysis(), budget_analysis(), spectra_analysis(),
                                                 frf_analysis(), compare_modes_analysis()};
  return all;
}

const AnalysisEntry &analysis_named(const std::string &name)
{
  std::vector<std::string> names;
  for (const AnalysisEntry &entry : analyses())
    if (entry.of.empty())
      if (names.push_back(entry.name); entry.name == name)
        return entry;
  throw std::invalid_argument("there is no analysis '" + name + "'" + suggestion(name, names));
}

Result computed(const AnalysisEntry &entry, Analysis &analysis, Session &session)
{
  analysis.check(session);
  return session.answered(entry.name, [&](Result &result) { analysis.compute(session, result); });
}

Analyses analyses_of(const std::string &command)
{
  Analyses own;
  for (const AnalysisEntry &entry : analyses())
    if (entry.of == command)
      own.push_back(entry.begin());
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

void check_all(const Analyses &analyses, Session &session)
{
  for (const auto &analysis : analyses)
    if (analysis->requested())
      analysis->check(session);
}

bool add_answers(const Analyses &analyses, Session &session, Result &result)
{
  bool all = true;
  for (const auto &analysis : analyses)
    if (analysis->requested() && !analysis->compute(session, result))
      all = false;
  return all;
}

Result complete_run(Session &session, const std::optional<std::string> &sensitivities)
{
  Result result = session.run(sensitivities);
  add_answers(analyses_of("run"), session, result);
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

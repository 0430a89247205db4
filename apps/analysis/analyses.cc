#include "apps/analysis/analyses.h"

#include "fem/values/nearest_name.h"

namespace gestell::apps
{

/// Each analysis, by the function NAME_analysis() of its folder.
#define GESTELL_ANALYSES(X) X(frf)

#define GESTELL_DECLARED(name) AnalysisEntry name##_analysis();
GESTELL_ANALYSES(GESTELL_DECLARED)

const std::vector<AnalysisEntry> &analyses()
{
#define GESTELL_LISTED(name) name##_analysis(),
  static const std::vector<AnalysisEntry> all = {GESTELL_ANALYSES(GESTELL_LISTED)};
  return all;
}

const AnalysisEntry &analysis_named(const std::string &name)
{
  std::vector<std::string> names;
  for (const AnalysisEntry &entry : analyses())
    if (names.push_back(entry.name); entry.name == name)
      return entry;
  throw std::invalid_argument("there is no analysis '" + name + "'" + suggestion(name, names));
}

Result computed(const AnalysisEntry &entry, const Analysis &analysis, Session &session)
{
  analysis.check();
  return session.answered(entry.name, [&](Result &result) { analysis.compute(session, result); });
}

Result result_of_all_kinds()
{
  Result all;
  for (const AnalysisEntry &entry : analyses())
    all.answers.push_back(entry.nothing());
  return all;
}

} // namespace gestell::apps

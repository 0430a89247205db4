#include "apps/output/tables/result_tables.h"

#include "coupling/simulation/checks/contacts_and_switches.h"

#include <algorithm>
#include <regex>

namespace gestell::apps
{
namespace
{

/// "press.toml:12: element.stop: never acts in this run ...; expected: ...": its place is the key it begins with.
coupling::Finding of_the_scene(const std::string &warning)
{
  static const std::regex begins(R"(^[^:\n]+:[0-9]+: ([A-Za-z_][^:\n]*): )");
  std::smatch             found;
  constexpr std::size_t   longest_place = 1000; // letters: std::regex takes some of the stack for each
  const std::string       head          = warning.substr(0, longest_place);
  const std::string       place         = std::regex_search(head, found, begins) ? found[1].str() : "";
  const bool              of_magnitude  = warning.find("; expected: ") != std::string::npos;
  return {coupling::Severity::warning, of_magnitude ? "magnitude" : place.empty() ? "" : "scene", place, warning};
}

/// Reason for an early end of a run, from the responsible check.
coupling::Finding early_end(const coupling::RunResult &run)
{
  return {coupling::Severity::error, run.end_id.empty() ? "stopped-early" : run.end_id, run.end_place,
          (is_wanted_end(run) ? "A switch ended the run: " : "The computation stopped early: ") + run.failure};
}

} // namespace

bool is_wanted_end(const coupling::RunResult &run)
{
  return run.end_id == coupling::ended_by_switch;
}

std::vector<coupling::Finding> all_findings(const Result &result)
{
  using coupling::Severity;
  std::vector<coupling::Finding> findings;
  const auto                     add = [&](const coupling::Finding &finding)
  {
    if (std::none_of(findings.begin(), findings.end(),
                     [&](const coupling::Finding &other) { return other.text == finding.text; }))
      findings.push_back(finding);
  };
  if (result.run && !result.run->failure.empty())
    add(early_end(*result.run));
  if (result.run && result.run->interrupted)
    add({Severity::warning, "interrupted", "", "The computation was interrupted; the results end at that time."});
  for (const std::string &warning : result.warnings)
    add(of_the_scene(warning));
  if (result.run)
    for (const coupling::Finding &finding : result.run->findings)
      add(finding);
  return findings;
}

std::vector<std::string> all_warnings(const Result &result)
{
  return coupling::texts_of(all_findings(result));
}

CsvTable history_csv(const coupling::RunResult &run)
{
  if (run.columns.empty())
    return {};
  CsvTable csv(heads_of(run.columns, run.units));
  csv.add_rows(run.rows);
  return csv;
}

} // namespace gestell::apps

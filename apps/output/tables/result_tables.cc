#include "apps/output/tables/result_tables.h"

#include "apps/output/text/csv.h"
#include "coupling/simulation/checks/contacts_and_switches.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <regex>

namespace gestell::apps
{
namespace
{

void append_modes(std::string &csv, const std::vector<coupling::Mode> &modes, const char *kind)
{
  int number = 0;
  for (const coupling::Mode &mode : modes)
  {
    csv += std::to_string(++number);
    for (const double x : {mode.frequency_hz, mode.damped_frequency_hz, mode.damping_ratio, mode.effective_mass[0],
                           mode.effective_mass[1], mode.effective_mass[2]})
      append_exact(csv += ',', x);
    csv += std::string(",") + kind + ',';
    append_exact(csv, mode.growth);
    append_exact(csv += ',', mode.refined_hz);
    csv += '\n';
  }
}

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

/// Why a run came to an early end, as the check that knows it tells.
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
    add({Severity::warning, "interrupted", "", "The computation was interrupted; the results end where it stopped."});
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

std::string history_csv(const coupling::RunResult &run)
{
  const std::size_t width = run.columns.size();
  std::string       csv;
  csv.reserve(20 * (run.rows.size() + width));
  for (std::size_t j = 0; j < width; ++j)
    csv += (j > 0 ? "," : "") + csv_field(run.columns[j] + " [" + run.units[j] + "]");
  csv += '\n';
  for (std::size_t i = 0; i + width <= run.rows.size(); i += width)
  {
    for (std::size_t j = 0; j < width; ++j)
    {
      if (j > 0)
        csv += ',';
      append_exact(csv, run.rows[i + j]);
    }
    csv += '\n';
  }
  return csv;
}

std::string modes_csv(const Result &result)
{
  std::string csv =
      "mode,frequency [Hz],damped frequency [Hz],damping ratio,"
      "effective mass x [kg],effective mass y [kg],effective mass z [kg],kind,growth [1/s],refined frequency [Hz]\n";
  append_modes(csv, result.frame_modes, "frame");
  append_modes(csv, result.coupled_modes, "coupled");
  return csv;
}

} // namespace gestell::apps

#include "apps/analysis/analysis_entry.h"
#include "apps/analysis/periodic/periodic_charts.h"
#include "apps/analysis/periodic/periodic_description.h"
#include "apps/analysis/periodic/periodic_headline.h"
#include "apps/analysis/periodic/periodic_motions.h"
#include "apps/analysis/periodic/periodic_tables.h"
#include "apps/output/tables/noise.h"
#include "coupling/periodic/periodic_methods.h"
#include "coupling/periodic/verified_orbit.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace gestell::apps
{

template <class Visitor>
void describe_answer(Visitor &v, const PeriodicResult &x)
{
  v.maybe(true, "periodic", x, "", "`periodic`");
}

std::string subject_of(const PeriodicResult &)
{
  return "Periodic solutions";
}

namespace
{

constexpr std::size_t most_rows = 40; ///< of tables and notes, a screen; the files have all

/// Every note once, in the order of solutions, with the numbers of those that have it: "1, 3 to 7".
std::vector<std::pair<std::string, std::string>> notes_of(const std::vector<PeriodicEntry> &entries)
{
  std::vector<std::string>                        notes;
  std::map<std::string, std::vector<std::size_t>> solutions;
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (const std::string &note : entries[i].solution.notes)
    {
      auto &numbers = solutions[note];
      if (numbers.empty())
        notes.push_back(note);
      if (numbers.empty() || numbers.back() != i + 1)
        numbers.push_back(i + 1);
    }
  std::vector<std::pair<std::string, std::string>> texts;
  for (std::size_t i = 0; i < std::min(notes.size(), most_rows); ++i)
  {
    const auto &numbers = solutions[notes[i]];
    std::string text;
    for (std::size_t first = 0, last = 0; first < numbers.size(); first = last + 1)
    {
      for (last = first; last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1;)
        ++last;
      text += (first > 0 ? ", " : "") + std::to_string(numbers[first]) +
              (last > first ? " to " + std::to_string(numbers[last]) : "");
    }
    texts.emplace_back(notes[i], text);
  }
  return texts;
}

std::string stability_of(const coupling::PeriodicSolution &solution)
{
  return !solution.stability_is_known() ? "unknown"
         : solution.stable()            ? "stable"
         : solution.verification.leaves ? "unstable in a run"
                                        : "unstable";
}

HtmlTable solutions_table(const PeriodicResult &result)
{
  std::vector<std::string> heads{"#no.", "kind", "#period [s]", "stability", "#largest multiplier", "#residual"};
  heads.insert(heads.end(), {"#deviation after " + std::to_string(coupling::verified_periods) + " periods",
                             "#share of initial states [%]", "method"});
  if (!result.parameter.empty())
    heads.insert(heads.begin() + 1, "#" + parameter_head(result));
  HtmlTable   table(heads);
  std::size_t number = 0;
  for (const PeriodicEntry &entry : result.entries)
  {
    if (++number > most_rows)
      break;
    const coupling::PeriodicSolution &s        = entry.solution;
    const bool                        verified = s.verification.periods == coupling::verified_periods;
    std::vector<HtmlTable::Cell>      row{std::to_string(number),
                                     kind_of(s),
                                     short_text(s.period, 10),
                                     peak(stability_of(s), s.stability_is_known() && !s.stable()),
                                     short_text(s.largest_multiplier(), 4),
                                     short_text(s.residual, 2),
                                     verified && s.stable() ? short_text(s.verification.departure, 2) : "",
                                     std::isnan(s.share) ? "" : short_text(100. * s.share, 3),
                                     s.method};
    if (!result.parameter.empty())
      row.insert(row.begin() + 1, short_text(entry.parameter, 8));
    table.add(row);
  }
  if (number > most_rows)
    table.add_note("... " + std::to_string(result.entries.size()) + " in total, see solutions.csv");
  return table;
}

HtmlTable signals_table(const PeriodicResult &result)
{
  HtmlTable   table({"#no.", "signal", "#largest", "#smallest", "#first harmonic", "unit"});
  std::size_t number = 0;
  for (const PeriodicEntry &entry : result.entries)
    if (const Noise noise = noise_of(entry.signals); ++number <= most_rows)
      for (const SignalOrbit &signal : entry.signals)
        table.add({std::to_string(number), signal.name, short_text(noise.without(signal.unit, signal.max), 6),
                   short_text(noise.without(signal.unit, signal.min), 6),
                   signal.amplitude.empty() ? "" : short_text(signal.amplitude[0], 6), signal.unit});
  return table;
}

HtmlTable special_table(const PeriodicResult &result)
{
  HtmlTable table({"special point", "#" + parameter_head(result), "#period [s]"});
  for (const SpecialPoint &point : result.special_points)
    table.add({point.kind, short_text(point.parameter, 10), short_text(point.period, 9)});
  return table;
}

HtmlTable checks_table(const PeriodicResult &result)
{
  HtmlTable table({"#no.", "second method", "signal", "#difference / amplitude"});
  int       number = 0;
  for (const PeriodicCheck &check : result.checks)
  {
    ++number;
    for (const auto &[name, distance] : check.distances)
      table.add({std::to_string(number), check.method, name, short_text(distance, 2)});
    if (!check.failure.empty())
      table.add_note(std::to_string(number) + ", by " + check.method + ": " + check.failure);
  }
  return table;
}

} // namespace

std::vector<Section> sections_of(const Result &, const PeriodicResult &periodic)
{
  Section    section{"periodic", "Periodic solutions", "Periodic solutions", Section::Place::first};
  const auto draw = [&](const std::string &name, const Chart &chart) {
    section.parts.push_back(Section::Drawing{name, chart, ChartLink::none, Section::Drawing::Shown::picture});
  };
  const auto draw_planes = [&](const std::string &name, const std::vector<PhasePlane> &planes, const auto &chart)
  {
    for (std::size_t j = 0; j < planes.size(); ++j)
      draw(name + std::to_string(j + 1), chart(planes[j]));
  };
  const auto say = [&](const std::string &text, bool page = false) {
    section.parts.push_back(Section::Sentences{text, page});
  };

  const PeriodicEntry   first                = periodic.entries.empty() ? PeriodicEntry() : periodic.entries.front();
  constexpr std::size_t most_response_charts = 6; // signals; the file has all
  for (std::size_t j = 0; j < std::min(first.signals.size(), most_response_charts) && !periodic.parameter.empty(); ++j)
  {
    draw("periodic-response-" + std::to_string(j + 1), response_chart(periodic, j));
    draw("periodic-amplitude-" + std::to_string(j + 1), amplitude_chart(periodic, j));
  }
  say(periodic.method + ": " + periodic.reason);
  section.parts.insert(section.parts.end(), {special_table(periodic), solutions_table(periodic)});
  if (periodic.parameter.empty())
    section.parts.push_back(signals_table(periodic));
  for (const auto &[note, solutions] : notes_of(periodic.entries))
    say("no. " + solutions + ": " + note);
  for (const std::string &note : periodic.notes)
    say(note);
  section.parts.push_back(checks_table(periodic));
  if (periodic.long_run)
  {
    say(long_run_text(*periodic.long_run));
    draw_planes("periodic-section-", periodic.long_run->planes,
                [&](const PhasePlane &plane) { return section_chart(plane, periodic.long_run->motion.periods); });
  }
  draw_planes("periodic-phase-", periodic.planes, phase_plane_chart);
  if (periodic.basins)
  {
    say(basins_text(*periodic.basins));
    draw("periodic-basins", basins_chart(*periodic.basins));
  }
  constexpr std::size_t most_multipliers = 12; // solutions whose marks a chart keeps apart
  if (!periodic.entries.empty())
    draw("periodic-multipliers", multiplier_chart(periodic.entries, most_multipliers));
  if (!first.signals.empty())
  {
    draw("periodic-harmonics", harmonics_chart(first, 1));
    if (const std::string others = not_barred(first); !others.empty())
      say(others, true);
  }
  return {section};
}

namespace
{

std::string names_of_methods()
{
  std::string names;
  for (const coupling::PeriodicMethod *method : coupling::periodic_methods())
    names += (names.empty() ? "" : ", ") + method->name();
  return names;
}

class Periodic : public Analysis
{
public:
  std::vector<CommandOption> options() override
  {
    std::vector<CommandOption> options{
        {"--method", &own_.method, names_of_methods() + " (default: chosen by the scene; the reason is printed)"},
        {"--period", &own_.period,
         "period of the excitation, such as \"0.2 s\" (default: from loads and rotating bodies)"},
        CommandOption{"--ratio", &own_.ratio, "number of excitation periods per period of the solution (default 1)"}
            .above_zero()
            .at_most(1000),
        {"--along", &own_.along, "trace the solutions over a scene key, such as parameters.speed"},
        CommandOption{"--from", &own_.from, "first value of this key, such as \"800 1/min\""}.with("--along"),
        CommandOption{"--to", &own_.to, "last value of this key"}.with("--along"),
        CommandOption{"--points", &own_.points, "approximate number of points of the branch (default 100)"}
            .above_zero()
            .at_most(1e6)
            .with("--along"),
        CommandOption{"--closing", &own_.tolerance,
                      "tolerance of the periodicity residual, relative to the speed (default 1e-10)"}
            .above_zero(),
        {"--check", &own_.check, "also compute each solution by a second method, and print the difference"},
        {"--basins", &own_.basins,
         "basins of attraction over two coordinates or rates, such as \"slide, slide'\" or \"slide from -1 to 1, "
         "slide' from -2 to 2\" (default range: twice the largest excursions of the solutions)"},
        CommandOption{"--basin-points", &own_.basin_points, "initial states along each axis (default 60)"}
            .above_zero()
            .at_most(2000)
            .with("--basins"),
        CommandOption{"--section", &own_.section,
                      "number of periods, 64 or more, for the long-term behaviour (default: 256 if no solution is "
                      "found, with minimise if none is stable)"}
            .above_zero()
            .at_most(1e6)};
    for (const coupling::PeriodicOption &of : coupling::options_of_periodic_methods())
    {
      double *const value = &numbers_.try_emplace(of.name, std::numeric_limits<double>::quiet_NaN()).first->second;
      const CommandOption option{"--" + of.name, value, of.meaning};
      options.push_back((of.least > 0. || !of.whole ? option.above_zero() : option).at_most(of.most));
    }
    return options;
  }
  void            check(Session &session) override { begin_branches(session, own_); }
  AnalysisOutcome compute(Session &session, Result &result) const override
  {
    PeriodicRequest request = own_;
    for (const auto &[name, number] : numbers_)
      if (!std::isnan(number))
        request.own[name] = number;
    PeriodicResult        found   = periodic_motions(session, request, result);
    const AnalysisOutcome outcome = found.interrupted       ? AnalysisOutcome::interrupted
                                    : found.failure.empty() ? AnalysisOutcome::done
                                                            : AnalysisOutcome::failed;
    if (outcome == AnalysisOutcome::failed)
      result.warnings.push_back(found.failure);
    result.answers.push_back(as_answer(std::move(found)));
    return outcome;
  }

private:
  PeriodicRequest               own_;
  std::map<std::string, double> numbers_; ///< options of single methods; nan: not given
};

template <auto table>
constexpr auto csv_of = content_of<PeriodicResult, table>;

std::vector<std::pair<std::string, std::string>> orbits_of(const Result &result)
{
  const auto *found = answer_in<PeriodicResult>(result.answers);
  return found ? orbit_files(*found) : std::vector<std::pair<std::string, std::string>>();
}

} // namespace

AnalysisEntry periodic_analysis()
{
  AnalysisEntry entry = analysis_entry<Periodic, PeriodicResult>(
      "periodic", "periodic solutions and their stability",
      {"gestell periodic apps/scenes/press.toml",
       "gestell periodic apps/scenes/press.toml --along parameters.s_cl --from \"0.1 mm\" --to \"0.6 mm\""},
      {{"solutions.csv", "periodic solutions with stability and signals, by `periodic`", csv_of<solutions_csv>},
       {"multipliers.csv", "Floquet multipliers of these solutions", csv_of<multipliers_csv>},
       {"special_points.csv", "points where solutions begin, end or change, with `periodic --along`",
        csv_of<special_points_csv>},
       {"orbit_*.csv", "one period of all signals, for each solution number", nullptr, "", "", orbits_of},
       {"section.csv", "states at the start of every period, if `periodic` computes the long-term behaviour",
        csv_of<section_csv>},
       {"basins.csv", "basins of attraction, with `periodic --basins`", csv_of<basins_csv>}});
  entry.motions = "periodic motions";
  return entry;
}

} // namespace gestell::apps

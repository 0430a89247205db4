#include "apps/analysis/comparison/scene_comparison.h"

#include "apps/analysis/analyses.h"
#include "apps/analysis/analysis_entry.h"
#include "apps/analysis/comparison/comparison_sections.h"
#include "apps/analysis/comparison/comparison_table.h"
#include "apps/analysis/comparison/shared_measures.h"
#include "apps/output/tables/result_tables.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

namespace
{

MachineAt at_modes(Session &session)
{
  coupling::Machine &machine = session.machine().small();
  return {&machine, modes_configuration(session.scene(), machine)};
}

std::string names_of(const std::vector<coupling::Signal> &signals)
{
  std::string names;
  for (const coupling::Signal &signal : signals)
    names += (names.empty() ? "" : ", ") + signal.name + " [" + signal.unit + "]";
  return names.empty() ? "none" : names;
}

void require_shared_signal(Session &session, Session &other)
{
  const auto a    = scene_signals(session.scene(), session.machine().machine);
  const auto b    = scene_signals(other.scene(), other.machine().machine);
  const auto in_b = [&](const coupling::Signal &own)
  {
    return std::any_of(b.begin(), b.end(),
                       [&](const auto &his) { return his.name == own.name && his.unit == own.unit; });
  };
  if (std::none_of(a.begin(), a.end(), in_b))
    throw std::invalid_argument("--compare: \"" + session.scene().name + "\" and \"" + other.scene().name +
                                "\" have no signal of the same name and unit; the first has " + names_of(a) +
                                ", the second " + names_of(b) + "; use the same names in [output.signals]");
}

std::string window_text(const coupling::RunResult &run)
{
  return std::isfinite(run.from) ? short_text(run.from, 6) + " s" : "the start of the run";
}

/// Base of analyses that also compute another scene.
class Compare : public Analysis
{
public:
  Compare(const char *does, void (*check)(Session &, Session &), void (*add)(Session &, Result &, Session &))
      : does_(does), check_(check), add_(add)
  {
  }

  std::vector<CommandOption> options() override { return {CommandOption{"--compare", &file_, does_}.existing_file()}; }
  bool                       requested(const Scene &) const override { return !file_.empty(); }
  std::vector<std::string>   reads() const override { return {file_}; }
  void                       check(Session &session) override
  {
    other_ = session.beside(file_);
    check_(session, *other_);
  }
  AnalysisOutcome compute(Session &session, Result &result) const override
  {
    if (!result.run || !result.run->interrupted)
      add_(session, result, *other_);
    return AnalysisOutcome::done;
  }

private:
  const char *does_;
  void (*check_)(Session &, Session &);
  void (*add_)(Session &, Result &, Session &);
  std::string              file_; ///< of the other scene; empty: none
  std::shared_ptr<Session> other_;
};

std::string compared_run_file(const Result &result)
{
  const auto *found = answer_in<ComparedRun>(result.answers);
  return found ? std::string(compared_run_csv(*result.run, *found)) : "";
}

CsvTable compared_history_csv(const ComparedRun &other)
{
  return history_csv(other.run);
}

void add_warnings(const Result &of_other, Result &result)
{
  for (const auto &warnings : {of_other.warnings, coupling::texts_of(of_other.run->findings)})
    for (const std::string &warning : warnings)
      result.warnings.push_back(of_other.scene + ": " + warning);
  if (!of_other.run->failure.empty())
    result.warnings.push_back(of_other.scene + " stopped early: " + of_other.run->failure);
}

} // namespace

void require_comparable_runs(Session &session, Session &other)
{
  other.check_run();
  require_shared_signal(session, other);
}

void add_compared_run(Session &session, Result &result, Session &other)
{
  Result of_other = run_with(analyses_of("run"), other);
  add_warnings(of_other, result);
  if (result.run && result.run->from != of_other.run->from)
    result.warnings.push_back("extremes are compared over different windows: output.from of " + result.scene + " is " +
                              window_text(*result.run) + ", that of " + of_other.scene + " " +
                              window_text(*of_other.run));
  auto shapes = compared_shapes(result, at_modes(session), of_other, at_modes(other));
  result.answers.push_back(compared_run_answer(compared_run(*result.run, of_other.scene, std::move(*of_other.run))));
  if (shapes)
    result.answers.push_back(as_answer(std::move(*shapes)));
}

void add_compared_modes(Session &session, Result &result, Session &other)
{
  const Result    of_other = other.modes();
  const MachineAt own = at_modes(session), his = at_modes(other);
  auto            shapes = compared_shapes(result, own, of_other, his);
  if (!shapes)
    throw std::invalid_argument(nothing_shared(result, own, of_other, his));
  result.answers.push_back(as_answer(std::move(*shapes)));
}

std::shared_ptr<const Answer> compared_run_answer(ComparedRun compared)
{
  return as_answer(std::move(compared));
}

AnalysisEntry compare_run_analysis()
{
  return {
      "compare",
      "",
      {},
      {{"compared_run.csv", "extremes compared with those of another scene, with `run --compare`", compared_run_file},
       {"compared_history.csv", "signals of the other run over time", content_of<ComparedRun, compared_history_csv>}},
      []
      {
        return std::make_unique<Compare>(
            "scene to compare with, run without --set: the charts and tables also show its signals, extremes and modes",
            require_comparable_runs, add_compared_run);
      },
      [] { return as_answer(ComparedRun()); },
      "run"};
}

AnalysisEntry compare_modes_analysis()
{
  return {"compare",
          "",
          {},
          {{"compared_modes.csv", "modes compared with those of another scene, with `--compare`",
            content_of<ComparedShapes, compared_modes_csv>},
           {"mac.csv", "MAC matrix of their shapes", content_of<ComparedShapes, mac_csv>}},
          []
          {
            return std::make_unique<Compare>(
                "scene to compare with: its modes are matched by measures of the same name",
                [](Session &, Session &) {}, add_compared_modes);
          },
          [] { return as_answer(ComparedShapes()); },
          "modes"};
}

} // namespace gestell::apps

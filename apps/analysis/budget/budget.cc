#include "apps/analysis/budget/budget.h"

#include "apps/analysis/analysis_entry.h"
#include "apps/sizing/error_budget.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{

template <class Visitor>
void describe_answer(Visitor &v, const ErrorBudget &x)
{
  v.maybe(true, "budget", by_name(x.entries, &BudgetEntry::output), "", "errors of each output, `run --budget`");
  v.maybe(true, "budget_cpu_s", x.cpu_s(), "s",
          "CPU time of the run and of each part of the budget, with the reduction of cached frames");
}

namespace
{

constexpr double bar = 0.6; ///< width, of the place it has

struct Cause
{
  const char *name;
  BudgetPart BudgetEntry::*part;
  double ErrorBudget::*cost;
};
constexpr Cause causes[] = {{"mesh", &BudgetEntry::mesh, &ErrorBudget::mesh_cpu_s},
                            {"reduction", &BudgetEntry::reduction, &ErrorBudget::reduction_cpu_s},
                            {"time", &BudgetEntry::time, &ErrorBudget::time_cpu_s}};

double percent_of(double error, const BudgetEntry &entry)
{
  return entry.value != 0. ? 100. * error / std::abs(entry.value) : 0.;
}

/// Errors in percent of the value, stacked by cause.
Chart errors_chart(const ErrorBudget &budget)
{
  Chart chart;
  chart.title    = "Output errors by cause";
  chart.note     = "output numbers: see the table below";
  chart.width    = 560.;
  chart.x.label  = "output";
  chart.y.label  = "error [% of the value]";
  chart.x.begin  = 0.5;
  chart.x.end    = double(budget.entries.size()) + 0.5;
  chart.y.begin  = 0.;
  double highest = 0.;
  for (std::size_t i = 0; i < budget.entries.size(); ++i)
  {
    const BudgetEntry &entry = budget.entries[i];
    double             below = 0.;
    for (int c = 0; c < 3; ++c)
      if (const auto &error = (entry.*causes[c].part).error)
      {
        const double height = percent_of(*error, entry), x = double(i + 1) - 0.5 * bar;
        chart.panels[0].tiles.push_back(
            {x, x + bar, below, below + height, c,
             entry.output + ", " + causes[c].name + ": " + short_text(*error, 2) + " " + entry.unit});
        below += height;
      }
    highest = std::max(highest, below);
    chart.x.ticks.push_back(double(i + 1));
  }
  for (int c = 0; c < 3; ++c)
    chart.panels[0].curves.push_back(tile_name(causes[c].name, c));
  chart.y.end = highest > 0. ? 1.08 * highest : 1.;
  return chart;
}

/// CPU time of the run, and of the estimate of each part of its error.
Chart cost_chart(const ErrorBudget &budget)
{
  Chart chart;
  chart.title        = "CPU time of the error budget";
  chart.note         = "1: the run; second models: 2 mesh, 3 reduction, 4 time";
  chart.width        = 480.;
  chart.x.begin      = 0.5;
  chart.x.end        = 4.5;
  chart.x.ticks      = {1., 2., 3., 4.};
  chart.x.label      = "computation";
  chart.y.label      = "CPU time [s]";
  chart.y.begin      = 0.;
  double     highest = 0.;
  const auto add     = [&](int place, double seconds, int colour, const char *name)
  {
    chart.panels[0].tiles.push_back({place - 0.5 * bar, place + 0.5 * bar, 0., seconds, colour,
                                     std::string(name) + ": " + short_text(seconds, 2) + " s"});
    highest = std::max(highest, seconds);
  };
  add(1, budget.run_cpu_s, 3, "run");
  for (int c = 0; c < 3; ++c)
    add(c + 2, budget.*causes[c].cost, c, causes[c].name);
  chart.y.end = highest > 0. ? 1.08 * highest : 1.;
  return chart;
}

std::string cell(const std::optional<double> &error)
{
  return error ? short_text(*error, 2) : "unknown";
}

} // namespace

std::vector<Section> sections_of(const Result &, const ErrorBudget &budget)
{
  Section section{"budget", "Error budget", "Error budget", Section::Place::results};
  section.parts.push_back(Section::Sentences{"Estimated errors of the outputs, each by comparison with a second model: "
                                             "another mesh, more modes, a finer integration.",
                                             true});
  for (const auto &[name, chart] :
       {std::pair("budget-errors", errors_chart(budget)), std::pair("budget-cost", cost_chart(budget))})
    section.parts.push_back(Section::Drawing{name, chart, ChartLink::none, Section::Drawing::Shown::picture});
  HtmlTable table(
      {"#no.", "output", "#value", "unit", "#mesh error", "#reduction error", "#time error", "#total error"});
  int number = 0;
  for (const BudgetEntry &entry : budget.entries)
  {
    table.add({std::to_string(++number), entry.output, short_text(entry.value, 7), entry.unit, cell(entry.mesh.error),
               cell(entry.reduction.error), cell(entry.time.error), cell(entry.total)});
    for (const Cause &cause : causes)
      if (const BudgetPart &part = entry.*cause.part; !part.error)
        table.add_note(entry.output + ", " + cause.name + ": " + part.reason +
                       (entry.bracket ? "; values are between " + short_text(entry.bracket->first, 5) + " and " +
                                            short_text(entry.bracket->second, 5) + " " + entry.unit
                                      : ""));
  }
  section.parts.push_back(table);
  return {section};
}

namespace
{

class Budget : public Analysis
{
public:
  std::vector<CommandOption> options() override
  {
    return {{"--budget", &requested_,
             "estimate the errors of outputs due to mesh, reduction and time integration, by a second model for each"},
            CommandOption{"--outputs", &list_,
                          "outputs of the budget, such as F.max,F.min,x.t_max,modes.2 (default: largest and smallest "
                          "value of every signal)"}
                .with("--budget")};
  }
  bool requested(const Scene &) const override { return requested_; }
  void check(Session &session) override { outputs_ = budget_outputs(session.scene(), list_); }
  /// A failure of the budget leaves its run intact; a run that stopped early has no budget.
  AnalysisOutcome compute(Session &session, Result &result) const override
  {
    if (!result.run->failure.empty() || result.run->interrupted)
      return AnalysisOutcome::done;
    try
    {
      result.answers.push_back(
          budget_answer(error_budget(session.scene(), outputs_, answer_of(result, outputs_), session.interruption())));
      return AnalysisOutcome::done;
    }
    catch (const std::runtime_error &failure)
    {
      result.warnings.push_back("no error budget: " + std::string(failure.what()));
      return session.interruption() && *session.interruption() ? AnalysisOutcome::interrupted : AnalysisOutcome::failed;
    }
  }

private:
  bool                    requested_ = false;
  std::string             list_;
  std::vector<OutputName> outputs_;
};

} // namespace

std::shared_ptr<const Answer> budget_answer(ErrorBudget budget)
{
  return as_answer(std::move(budget));
}

AnalysisEntry budget_analysis()
{
  return analysis_entry<Budget, ErrorBudget>("budget", "", {}, {}, "run");
}

} // namespace gestell::apps

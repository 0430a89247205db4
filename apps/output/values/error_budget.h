#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Share of one part of the model in the error of an output.
struct BudgetPart
{
  std::optional<double> error;  ///< absolute, in the unit of the output; none: not known
  std::string           reason; ///< why it is not known, or what the number rests on
};

/// An output of a run with its error, by what causes it.
struct BudgetEntry
{
  std::string                              output; ///< "F_P.max", "modes.2"
  std::string                              unit;
  double                                   value = 0.;
  BudgetPart                               mesh, reduction, time;
  std::optional<double>                    sides;   ///< of the mesh's error what straight sides leave; none: not known
  std::optional<double>                    total;   ///< sum of the three; none where one is not known
  std::optional<std::pair<double, double>> bracket; ///< smallest and largest value of all models computed
};

template <class Visitor>
void describe_errors(Visitor &v, const BudgetEntry &x)
{
  v("value", x.value, x.unit, "of the output");
  v("unit", x.unit, "", "of value and errors");
  v("mesh", x.mesh.error, x.unit, "error by the mesh; null: not known");
  v("reduction", x.reduction.error, x.unit, "error by the reduction; null: not known");
  v("time", x.time.error, x.unit, "error by the integration; null: not known");
  v("total", x.total, x.unit, "sum of the three; null: one is not known");
}

template <class Visitor>
void describe(Visitor &v, const BudgetEntry &x)
{
  describe_errors(v, x);
  v.maybe(x.bracket.has_value(), "bracket",
          x.bracket ? std::vector{x.bracket->first, x.bracket->second} : std::vector<double>(), x.unit,
          "smallest and largest value of all models");
  v("reasons",
    std::vector<std::pair<std::string, std::string>>{
        {"mesh", x.mesh.reason}, {"reduction", x.reduction.reason}, {"time", x.time.reason}},
    "", "why an error is not known, or what it rests on");
}

/// Errors of chosen outputs, summed from mesh, reduction and integration.
struct ErrorBudget
{
  std::vector<BudgetEntry> entries;
  double                   run_cpu_s = 0.; ///< of the run itself
  /// What each part cost to find out.
  double mesh_cpu_s = 0., reduction_cpu_s = 0., time_cpu_s = 0.;

  std::vector<std::pair<std::string, double>> cpu_s() const
  {
    return {{"run", run_cpu_s}, {"mesh", mesh_cpu_s}, {"reduction", reduction_cpu_s}, {"time", time_cpu_s}};
  }
};

} // namespace gestell::apps

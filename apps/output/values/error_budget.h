#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Contribution of one part of the model to the error of an output.
struct BudgetPart
{
  std::optional<double> error;  ///< absolute, in the unit of the output; none: unknown
  std::string           reason; ///< why it is unknown, or on which assumption the number is based
};

/// An output of a run with its error, split by cause.
struct BudgetEntry
{
  std::string                              output; ///< "F_P.max", "modes.2"
  std::string                              unit;
  double                                   value = 0.;
  BudgetPart                               mesh, reduction, time;
  std::optional<double>                    sides;   ///< mesh error caused by straight element sides; none: unknown
  std::optional<double>                    total;   ///< sum of the three; none if one of them is unknown
  std::optional<std::pair<double, double>> bracket; ///< smallest and largest value of all models computed
};

template <class Visitor>
void describe_errors(Visitor &v, const BudgetEntry &x)
{
  v("value", x.value, x.unit, "of the output");
  v("unit", x.unit, "", "of value and errors");
  v("mesh", x.mesh.error, x.unit, "error due to the mesh; null: unknown");
  v("reduction", x.reduction.error, x.unit, "error due to the reduction; null: unknown");
  v("time", x.time.error, x.unit, "error due to the time integration; null: unknown");
  v("total", x.total, x.unit, "sum of the three; null: one is unknown");
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
    "", "reason why an error is unknown, or its basis");
}

/// Errors of chosen outputs, as sums of mesh, reduction and integration errors.
struct ErrorBudget
{
  std::vector<BudgetEntry> entries;
  double                   run_cpu_s = 0.; ///< of the run itself
  /// CPU time [s] spent to estimate each part.
  double mesh_cpu_s = 0., reduction_cpu_s = 0., time_cpu_s = 0.;

  std::vector<std::pair<std::string, double>> cpu_s() const
  {
    return {{"run", run_cpu_s}, {"mesh", mesh_cpu_s}, {"reduction", reduction_cpu_s}, {"time", time_cpu_s}};
  }
};

} // namespace gestell::apps

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

/// Errors of chosen outputs, summed from mesh, reduction and integration.
struct ErrorBudget
{
  std::vector<BudgetEntry> entries;
  double                   run_cpu_s = 0.; ///< of the run itself
  /// What each part cost to find out.
  double mesh_cpu_s = 0., reduction_cpu_s = 0., time_cpu_s = 0.;
};

} // namespace gestell::apps

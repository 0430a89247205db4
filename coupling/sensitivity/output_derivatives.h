#pragma once

#include <Eigen/Core>

#include <string>

namespace gestell::coupling
{

constexpr double one_percent = 0.01; ///< of a parameter, of which changes are told

/// A number that a run tells, with its derivatives by the parameters [K]; nan: it has none, and `note` tells why.
struct OutputDerivatives
{
  std::string     output; ///< "F_P.max", "F_P.t_max", "F_P.final", "events.3.t"
  std::string     unit;
  double          value = 0.;
  Eigen::VectorXd derivative;      ///< [unit / unit of the parameter]
  std::string     note{};          ///< of an event: "sheet tool_contact"; or why there is no derivative
  bool            is_zero = false; ///< but for rounding: changes of it are no percentages
};

} // namespace gestell::coupling

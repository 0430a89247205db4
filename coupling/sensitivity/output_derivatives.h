#pragma once

#include <Eigen/Core>

#include <string>

namespace gestell::coupling
{

constexpr double one_percent = 0.01; ///< of a parameter, reference of reported changes

/// A scalar result of a run, with its derivatives by the parameters [K]; nan: none, see `note`.
struct OutputDerivatives
{
  std::string     output; ///< "F_P.max", "F_P.t_max", "F_P.final", "events.3.t"
  std::string     unit;
  double          value = 0.;
  Eigen::VectorXd derivative;      ///< [unit / unit of the parameter]
  std::string     note{};          ///< for an event: "sheet tool_contact"; or why there is no derivative
  bool            is_zero = false; ///< within rounding: changes are not given in percent
};

} // namespace gestell::coupling

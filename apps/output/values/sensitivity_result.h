#pragma once

#include <Eigen/Core>

#include <limits>
#include <string>
#include <vector>

namespace gestell::apps
{

/// An entry of the scene by which outputs are differentiated.
struct SensitivityKey
{
  std::string key, unit; ///< "parameters.c_P", "kg/s^2"; empty: a plain number, in SI
  double      value = 0.;
  std::string frame{}; ///< how the frame's share is found, where the entry changes it; else empty
};

/// A number of the run with its derivatives.
struct SensitivityOutput
{
  std::string     output, unit; ///< "F_P.max", "N"
  std::string     note;         ///< of an event what happens; or why there is no derivative
  double          value = 0.;
  Eigen::VectorXd derivative;      ///< by every key [unit / unit of the key]; nan: there is none
  bool            is_zero = false; ///< but for rounding

  /// Relative change [%] of the output by 1 % more of a key; nan where the output is zero.
  double percent(const SensitivityKey &key, Eigen::Index k) const
  {
    return is_zero ? std::numeric_limits<double>::quiet_NaN() : derivative[k] * key.value / value;
  }
};

/// Derivatives of what a run tells.
struct SensitivityResult
{
  std::vector<SensitivityKey>    keys;
  std::vector<SensitivityOutput> outputs;
  std::string                    failure{};                  ///< why there are none, though the run is there
  bool                           interrupted = false;        ///< some are not known
  long                           steps       = 0;            ///< of the variational equations
  double                         run_cpu_s = 0., cpu_s = 0.; ///< of the run, and of all derivatives
};

} // namespace gestell::apps

#pragma once

#include "apps/study/values/study_table.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// What one run of a study gave.
struct RunRow
{
  int                      run    = 0; ///< from 1
  RunStatus                status = RunStatus::waiting;
  std::string              message{}; ///< why it failed
  std::vector<double>      values{};  ///< one an output, nan of none
  std::vector<std::string> units{};   ///< of the values; empty of a failed run
  double                   cpu_s        = 0.;
  bool                     lacks_output = false; ///< it failed for an output that names what the run does not have
};

} // namespace gestell::apps

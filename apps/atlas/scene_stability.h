#pragma once

#include "apps/output/report/stability_report.h"
#include "apps/session/prepared_machine.h"

#include <vector>

namespace gestell::apps
{

/// Checks a scene's own method and all others at its step: modes, verdicts and notes of the study.
/// @param step  [s] step to check; 0: run.step
/// @throws std::invalid_argument if there is none
void lay_methods_over(const Scene &scene, PreparedMachine &prepared, double step,
                      const std::vector<MethodFamily> &families, StabilityStudy &study);

} // namespace gestell::apps

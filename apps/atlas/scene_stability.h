#pragma once

#include "apps/output/report/stability_report.h"
#include "apps/session/prepared_machine.h"

#include <vector>

namespace gestell::apps
{

/// Modes of a scene under its own method and under all others, at its step: modes, verdicts and notes of the study.
/// @param step  [s] to look at; 0: run.step
/// @throws std::invalid_argument if there is none
void lay_methods_over(const Scene &scene, PreparedMachine &prepared, double step,
                      const std::vector<MethodFamily> &families, StabilityStudy &study);

} // namespace gestell::apps

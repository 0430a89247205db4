#pragma once

#include "apps/study/report/study_findings.h"
#include "apps/study/runs/study_runner.h"

#include <filesystem>

namespace gestell::apps
{

/// The optimum in the units of the variables.
Eigen::VectorXd levels_of(const StudyFindings &findings);

/// Writes what was found beside the rows: tables, pictures, report.html and optimum.toml; what an earlier call found
/// and this one did not is removed.
/// @throws std::runtime_error if a file cannot be written to its end
void write_findings(const std::filesystem::path &folder, const StudyFile &study, const SceneVariants &variants,
                    const StudyFindings &findings);

} // namespace gestell::apps

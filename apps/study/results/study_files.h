#pragma once

#include "apps/study/report/study_findings.h"
#include "apps/study/runs/study_runner.h"

#include <filesystem>
#include <string>
#include <vector>

namespace gestell::apps
{

/// The optimum in the units of the variables.
Eigen::VectorXd levels_of(const StudyFindings &findings);

/// A scene file that extends that of the study by its settings and by these levels of the variables; its path is
/// relative to `folder`, where it is meant to be.
std::string optimum_scene(const StudyFile &study, const SceneVariants &variants, const Eigen::VectorXd &levels,
                          const std::filesystem::path &folder);

/// Names of the files that a study writes in addition to its rows, for OwnFolder::require_free().  Rows are recognised
/// by their content.
const std::vector<std::string> &study_names();

/// Writes what was found beside the rows: tables, pictures, report.html and optimum.toml; what an earlier call found
/// and this one did not is removed.
/// @throws coupling::WriteFailure as write_or_rescue()
void write_findings(const std::filesystem::path &folder, const StudyFile &study, const SceneVariants &variants,
                    const StudyFindings &findings);

} // namespace gestell::apps

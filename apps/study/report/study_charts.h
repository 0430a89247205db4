#pragma once

#include "apps/study/report/study_findings.h"

#include <string>

namespace gestell::apps
{

/// An output over each variable alone, the others in the middle of their ranges and, if there is one, at the optimum;
/// with the interval of confidence of the fit.  A panel per variable.
std::string slices_chart(const ResponseSurface &surface, const std::vector<StudyVariable> &variables,
                         const Eigen::VectorXd *optimum);

/// What the surface says against what the runs computed; rings: of surfaces that did not know the run.
std::string predicted_chart(const ResponseSurface &surface, const std::vector<int> &run_numbers);

/// Two goals of the front against each other: runs, those of them that none dominates, the front on the surfaces, the
/// optimum.
std::string pareto_chart(const StudyFindings &findings, int first_goal, int second_goal);

} // namespace gestell::apps

#pragma once

#include "apps/study/runs/output_formulas.h"
#include "apps/study/runs/scene_variants.h"

#include <string>

namespace gestell::apps
{

/// Entries of the scene by which a run is differentiated for these variables, "parameters.c_P,parameters.s_cl".
/// @throws std::invalid_argument for a variable with several keys, or words
std::string differentiated_keys(const std::vector<VariableRequest> &variables);

/**
 * Derivatives of the outputs by the levels of the variables [outputs x variables], from the sensitivities of a run by
 * differentiated_keys(): those of the entries are exact, formulas are differentiated by quotients.
 *
 * @throws std::invalid_argument for an entry without a derivative
 */
Eigen::MatrixXd output_derivatives(const OutputFormulas &outputs, const Result &result, const SceneVariants &variants,
                                   const std::vector<VariableRequest> &variables, const Eigen::VectorXd &levels);

} // namespace gestell::apps

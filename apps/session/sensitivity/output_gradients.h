#pragma once

#include "fem/values/cad_source.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace gestell::apps
{

/// Outputs of a run with their derivatives.
struct OutputGradients
{
  std::vector<double> values;    ///< one per output
  Eigen::MatrixXd     gradients; ///< [outputs x keys], by the value of a key in SI; nan: there is none
};

/// What a gradient method asks for: the scene run once with these entries, and its outputs differentiated.
/// @param overrides  values of the scene, "parameters.c_P=950 kN/mm"
/// @param keys       by which to differentiate, "parameters.c_P"
/// @param outputs    "F_P.min", "F_P.t_min", "events.3.t", "modes.2"
/// @throws std::invalid_argument as run() and for an output that the run does not have (nearest named);
/// ConvergenceFailure if the run fails
OutputGradients output_gradients(const std::string &path, const std::vector<std::string> &overrides,
                                 const std::vector<std::string> &keys, const std::vector<std::string> &outputs,
                                 fem::Scripts scripts = fem::Scripts::harmless);

} // namespace gestell::apps

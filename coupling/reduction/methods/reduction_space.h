#pragma once

#include "coupling/reduction/estimates/refined_modes.h"
#include "coupling/reduction/shapes/reduction_basis.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * The columns of T chosen by a method, and its knowledge of the modes of the supported frame with free interface. All
 * reductions share one projection by their common structure: E and zeros on the rows of q1, constraint modes orthogonal
 * in C to all others, the others orthonormal in M and orthogonal in C (ReductionBasis).
 */
struct ReductionSpace
{
  ReductionBasis  basis;        ///< constraint modes, and fixed-interface modes or none
  Eigen::MatrixXd attachment{}; ///< shapes [n x k], zero on q1, to join them: append_attachment_modes()
  ReducedMatrices star{};       ///< of `basis` alone, where the method has made them

  RefinedModes                   refined{};        ///< better than the model has them; n_rigid at least
  std::optional<Eigen::VectorXd> exact{};          ///< in place of it frequencies that the model has exactly [rad/s]
  double                         limit = INFINITY; ///< [rad/s] up to which the model should be valid

  std::vector<std::string> statements{}, notes{};
};

} // namespace gestell::coupling

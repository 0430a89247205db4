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
  Eigen::MatrixXd attachment{}; ///< shapes [n x k], zero on q1, to be appended: append_attachment_modes()
  ReducedMatrices star{};       ///< of `basis` alone, if the method has computed them

  RefinedModes                   refined{};        ///< more accurate than those of the model; at least n_rigid
  std::optional<Eigen::VectorXd> exact{};          ///< in place of `refined`: exact frequencies of the model [rad/s]
  double                         limit = INFINITY; ///< [rad/s] limit of validity of the model

  std::vector<std::string> statements{}, notes{};
};

} // namespace gestell::coupling

#pragma once

#include "coupling/machine/machine.h"

namespace gestell::coupling
{

/// Geometric stiffness [n_u x n_u], block diagonal, of elements and joints at a motion with its forces and multipliers;
/// for an element with a position function g(u), whose force is P grad g, it is -P g''.
Eigen::MatrixXd geometric_of_measures(const Machine &machine, const LocalState &state);

/// The same plus the stiffness of the elements engaged at q; elements named in `open` contribute their open branch.
Eigen::MatrixXd stiffness_of_measures(const Machine &machine, const LocalState &state,
                                      const std::vector<std::string> &open);

/// Whether the geometric stiffness is not symmetric: a follower force has no potential (circulatory forces).
/// @param acts  [n_u] 0 for the measures of elements that do not act
bool is_circulatory(const Machine &machine, const LocalState &state, const Eigen::VectorXd &acts);

/// Sum of the magnitudes of the terms of the elements' part of v^T K v, for each motion v, a column of V: |u|^T |K| |u|
/// in the measures u = W^T v of each element and joint, engaged at q or open, and, with a state, their geometric
/// stiffness. This times epsilon is the rounding error of a sum that is zero.
Eigen::VectorXd stiffness_terms(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                                const LocalState *geometric, const Eigen::MatrixXd &V);

} // namespace gestell::coupling

#pragma once

#include "coupling/machine/machine.h"

namespace gestell::coupling
{

/// The base matrices as dense ones [n x n], for small machines.
Eigen::MatrixXd dense_mass(const Machine &machine);
Eigen::MatrixXd dense_damping(const Machine &machine);
Eigen::MatrixXd dense_stiffness(const Machine &machine);

/// Stiffness and damping W K W^T, W D W^T [n x n] of the elements engaged at q; elements named in `open` contribute
/// their open branch.
/// @throws std::invalid_argument for a name in `open` that no element has, or one that is never open.
void engaged_matrices(const Machine &machine, const Eigen::VectorXd &q, const std::vector<std::string> &open,
                      Eigen::MatrixXd &stiffness, Eigen::MatrixXd &damping);

/// W K W^T of the same as a sparse matrix, for machines of any size.
Eigen::SparseMatrix<double> engaged_stiffness(const Machine &machine, const Eigen::VectorXd &q,
                                              const std::vector<std::string> &open);

/// Which elements have forces.
enum class Acting
{
  everything,
  structure ///< not those with zero Structure::engaged(): technological forces, drives
};

/// 1 for the measures [n_u] of elements and joints that act at u [n_u], 0 for the others.
Eigen::VectorXd acting_measures(const Machine &machine, const Eigen::VectorXd &u, Acting acting);

/// Geometric stiffness W K_g W^T [n x n] of elements and joints at a motion with its forces and multipliers; for an
/// element with a position function g(u), whose force is P grad g, K_g = -P g''.
Eigen::MatrixXd geometric_stiffness(const Machine &machine, const LocalState &state,
                                    Acting acting = Acting::everything);

/// G W^T [n_c x n]: the equations of the joints in the coordinates of the machine.  A row that is only rounding of its
/// terms is set to zero: no motion changes its equation here.
Eigen::MatrixXd joint_jacobian(const Machine &machine, const ConstraintJacobian &G);

/// Orthonormal columns [n x n - rank] that span the motions allowed by the joints, G W^T Z = 0, with the coordinates
/// `fixed` at rest.
Eigen::MatrixXd free_motions(const Machine &machine, const LocalState &state, const std::vector<int> &fixed = {});

/// The same of all elements in the stiffest branch of their laws.
void stiffest_matrices(const Machine &machine, const Eigen::VectorXd &q, Eigen::MatrixXd &stiffness,
                       Eigen::MatrixXd &damping);

/// The same of all elements while they are open: forces that act permanently.
void open_matrices(const Machine &machine, const Eigen::VectorXd &q, Eigen::MatrixXd &stiffness,
                   Eigen::MatrixXd &damping);

} // namespace gestell::coupling

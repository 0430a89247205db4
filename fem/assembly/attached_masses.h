#pragma once

#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"
#include "fem/values/mass_properties.h"

#include <vector>

namespace gestell::fem
{

/// @throws std::invalid_argument for values impossible for a rigid body and for an unknown interface, with the most
///   similar names.
void require_valid(const std::vector<AttachedMass> &masses, const std::vector<InterfaceSpecification> &interfaces);

/// Nodes at the centres of the masses with their own surfaces, coupled to these like interfaces.
std::vector<InterfaceSpecification> nodes_of_masses(const std::vector<AttachedMass> &masses);

/// The node that carries the mass, among those of masses and then of interfaces.
const Interface &node_of(const AttachedMass &mass, const std::vector<Interface> &nodes);

/// The rigid body of an attached mass.
MassProperties properties_of(const AttachedMass &mass, const Interface &node);

/**
 * Contributions of masses to M [n x n] and to the load of a unit acceleration [n x 3].  A node at x0 with coordinates
 * p = (u0, theta) carries a rigid body of centre x_c as
 *
 *     M_node = m R^T R + [ 0 0 ; 0 J ],     R = [ I  -(x_c - x0)x ],     load in direction d:  m R^T e_d.
 *
 * @param nodes  of masses and interfaces by the names in nodes_of_masses() and of the interfaces.
 */
Eigen::SparseMatrix<double> mass_matrix(const std::vector<AttachedMass> &masses, const std::vector<Interface> &nodes,
                                        int n);
void add_loads(const std::vector<AttachedMass> &masses, const std::vector<Interface> &nodes, Eigen::MatrixXd &load);

} // namespace gestell::fem

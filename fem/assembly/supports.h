#pragma once

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/surface_patch.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"

#include <vector>

namespace gestell::fem
{

/// A support with its surfaces.
struct SupportedPatch
{
  Support      support;
  SurfacePatch patch;
};

/**
 * Finds the surfaces and checks the numbers; values per area are converted to totals.
 *
 * @throws std::invalid_argument for unknown surfaces, negative stiffness or damping, a foundation with none.
 */
std::vector<SupportedPatch> find_supports(const Mesh &mesh, const QuadraticMesh &quadratic,
                                          const std::vector<Support> &supports);

/// Fixes the displacements of clamped supports.
void hold(const std::vector<SupportedPatch> &supports, MultipointConstraints &constraints);

/**
 * Elastic foundations in the coordinates of the frame:  sum_d (k_d / A) a_d a_d^T int N N^T dA,  k_d the total
 * stiffness [N/m] along the axis a_d.
 *
 * @param totals Support::stiffness (into C) or Support::damping (into B).
 */
Eigen::SparseMatrix<double> foundations(const std::vector<SupportedPatch> &supports, Vector3 Support::*totals,
                                        const AffineConstraints &affine);

/**
 * Forces of supports on the frame, "support.NAME.x", ".y", ".z" [N]; a foot pressed down gives z > 0.
 *
 * Foundation:  -K/A int u dA - D/A int u' dA,  K = sum_d k_d a_d a_d^T  and D alike.
 * Clamped:      sum over held nodes of the rows of C u + M u'' for direction d and of damping after Rayleigh; with
 *               what foundations that share nodes with it push them by; less their weight, so that at rest the supports
 *               carry all of the frame, and in motion all of its inertia.  A node of several supports counts for the
 *               first.
 *
 * @param nodal_mass  [nodes] sums of the rows of M [kg].
 * @param rayleigh    alpha [1/s] and beta [s] of all cells.
 */
std::vector<FrameOutput> support_forces(const std::vector<SupportedPatch> &supports, const QuadraticMesh &mesh,
                                        const CellMaterials &materials, const AffineConstraints &affine,
                                        const Eigen::VectorXd &nodal_mass, const std::array<double, 2> &rayleigh);

} // namespace gestell::fem

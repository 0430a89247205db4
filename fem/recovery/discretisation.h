#pragma once

#include "fem/recovery/mesh_error.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"
#include "fem/values/mesh.h"

#include <memory>

namespace gestell::fem
{

/**
 * M, B, C of an elastic frame in quadratic tetrahedra with straight or curved sides, hexahedra and prisms, with
 * supports, interfaces, cuts and picture.
 *
 *     M q'' + B q' + C q = f,    u = G q,    M = G^T M_full G  and so on
 *
 * q contains the displacements of all nodes that are neither clamped nor tied, then inner coordinates of averaged
 * surfaces, then coordinates (ux uy uz rx ry rz; for a node of the mesh ux uy uz) for each attached mass with its own
 * surfaces and for each interface in the order of the specification.  B contains the dampers of the foundations; modal
 * damping remains a ratio. Outputs: "support.NAME.x|y|z", "cut.NAME" and "stress.NAME.xx", see support_forces(),
 * cut_forces() and add_stress_points().
 *
 * Uses the specification except CAD file, mesh options and selectors.  Initialises PETSc (petsc_session()).
 *
 * @throws std::invalid_argument for wrong input, with location, value, requirement and remedy.
 */
FrameMatrices discretise(const Mesh &mesh, const FrameSpecification &specification);

/// The same with the estimator of the discretisation error.
struct Discretisation
{
  FrameMatrices                    matrices;
  std::shared_ptr<const MeshError> mesh_error;
  Eigen::VectorXd                  prestress_load{}; ///< [n] of FrameSpecification::prestress
  SparseMatrix                     geometric{};      ///< stiffness contained in C, or empty
  /// [n1 x n1] added to C in the interface coordinates of a prestressed part, so that it can float; or empty.
  Eigen::MatrixXd balance{};
};

/// @param q0  [n] static deflection under the prestress: C, and what is read off it, then contains the geometric
///            stiffness of its stresses, and beta of Rayleigh damping acts on both.  Empty: unstressed.
Discretisation discretise_with_mesh_error(const Mesh &mesh, const FrameSpecification &specification,
                                          const Eigen::VectorXd &q0 = {});

/// The same without the sums over cells, which MeshError::parts() makes part by part: M, B and C are those of attached
/// masses, of foundations and of stiffness_of_turns().
Discretisation discretise_for_parts(const Mesh &mesh, const FrameSpecification &specification,
                                    const Eigen::VectorXd &q0 = {});

} // namespace gestell::fem

#pragma once

#include "coupling/reduction/craig_bampton.h"
#include "fem/mesh.h"
#include "fem/mesh_error.h"

#include <string>

namespace gestell::coupling
{

/// Estimated relative errors that the mesh leaves in elastic frequencies of a reduced frame [k]: at most six, from the
/// first to the last within its frequency limit; docs/theory/mesh_error.md (3).
Eigen::VectorXd modal_mesh_error(const Reduction &reduced, const fem::MeshError &mesh_error);

struct MeshStatement
{
  std::string text;
  bool        warns = false;
};

/**
 * What a user should know about the mesh: "mesh: 21 000 coordinates; by the stresses of the modes the
 * frequencies up to 80 Hz are 1 % to 12 % too high ...", and where walls are thinner than the elements, how thin.
 * Errors below 2 % are no reason to warn.
 */
MeshStatement mesh_statement(const Reduction &reduced, const fem::MeshError &mesh_error, const fem::Mesh &mesh);

} // namespace gestell::coupling

#pragma once

#include "coupling/reduction/reduce_frame.h"
#include "fem/recovery/mesh_error.h"
#include "fem/values/mesh.h"

#include <string>

namespace gestell::coupling
{

/// Relative errors that the mesh leaves in elastic frequencies of a reduced frame, as estimated.
struct MeshErrorEstimate
{
  Eigen::VectorXd error;           // [k] of modes up to highest_hz, or of some of them, the first and the last included
  double          highest_hz = 0.; ///< the frequency limit, or that of the last mode looked at
  bool            raised     = false; ///< by elements of degree three; else by stresses
};

/**
 * By elements of degree three on the same mesh, where these cost no more than the reduction; else by the stresses of at
 * most six modes, which miss much of the error where walls are thinner than the elements: docs/theory/mesh_error.md.
 *
 * @param frame       that was reduced
 * @param thin_walls  whether such walls are no small part of it
 */
MeshErrorEstimate modal_mesh_error(const ReducedModel &reduced, const fem::FrameMatrices &frame,
                                   const fem::MeshError &mesh_error, bool thin_walls);

struct MeshStatement
{
  std::string text;
  bool        warns = false;
};

/**
 * What a user should know about the mesh: "mesh: 21 000 coordinates; judged by elements of degree three, frequencies
 * up to 80 Hz are 1 % to 12 % too high ...", and where walls are thinner than the elements, how thin.  Errors below 2 %
 * are no reason to warn unless they are known from below alone.
 */
MeshStatement mesh_statement(const ReducedModel &reduced, const fem::FrameMatrices &frame,
                             const fem::MeshError &mesh_error, const fem::Mesh &mesh);

} // namespace gestell::coupling

#pragma once

#include "coupling/reduction/reduce_frame.h"
#include "fem/recovery/mesh_error.h"
#include "fem/values/mesh.h"

#include <string>

namespace gestell::coupling
{

/// Estimated relative mesh errors of the elastic frequencies of a reduced frame.
struct MeshErrorEstimate
{
  Eigen::VectorXd error;              // [k] of modes up to highest_hz, or of some of them, with the first and the last
  double          highest_hz = 0.;    ///< the frequency limit, or the highest mode evaluated
  bool            raised     = false; ///< from elements of degree three; else from stresses
};

/**
 * Uses elements of degree three on the same mesh if these cost no more than the reduction; else the stresses of at most
 * six modes, which miss much of the error if walls are thinner than the elements: docs/theory/mesh_error.md.
 *
 * @param frame       the frame that was reduced
 * @param thin_walls  whether such walls are a significant part of it
 */
MeshErrorEstimate modal_mesh_error(const ReducedModel &reduced, const fem::FrameMatrices &frame,
                                   const fem::MeshError &mesh_error, bool thin_walls);

/// Largest relative error of the same frequencies by the ties between meshes of solids, see fem::tie_work().
double tie_error(const ReducedModel &reduced, const fem::MeshError &mesh_error);

/// Whether a frame of n coordinates is small enough for elements of degree three, which need its matrices.
bool may_be_raised(const fem::MeshError &mesh_error, double n);

struct MeshStatement
{
  std::string text;
  bool        warns = false;
};

/**
 * Information for the user about the mesh: "mesh: 21 000 coordinates; judged by elements of degree three, frequencies
 * up to 80 Hz are 1 % to 12 % too high ...", and if walls are thinner than the elements, their thickness.  Errors below
 * 2 % cause no warning unless they are only lower bounds.
 */
MeshStatement mesh_statement(const ReducedModel &reduced, const fem::FrameMatrices &frame,
                             const fem::MeshError &mesh_error, const fem::Mesh &mesh);

} // namespace gestell::coupling

#pragma once

#include "coupling/frame/mesh_convergence.h"
#include "coupling/frame/reduction_options.h"
#include "fem/values/frame_specification.h"

namespace gestell::coupling
{

/**
 * Refines the mesh of a frame until its lowest elastic frequencies (supported, interface free) and the static
 * compliance of each of its interfaces are within a tolerance.
 *
 * The first mesh is that of the specification.  Each further mesh is refined where the estimated errors of the fields
 * are large (fem::MeshError, fem::refine()).  The limit of each quantity is extrapolated (extrapolate()).  Refinement
 * ends when, for all quantities, the sum of the error of the last mesh and the uncertainty of the limit is within the
 * tolerance, or when a limit of the options is reached: `stopped` then gives the reason, and the statement refers to
 * the last mesh.
 *
 * The compliance of an interface is the largest displacement of its node [m] under a unit force [N] of any direction
 * (for a floating frame under balanced forces): the largest eigenvalue of the node's block of S^+, S = C*_11.
 *
 * @throws std::invalid_argument for options out of range, a mesh file (it cannot be refined), wrong input of the frame.
 */
MeshConvergence converge_mesh(fem::FrameSpecification specification, const ReductionOptions &reduction,
                              const ConvergenceOptions &options, const Progress &progress = {});

} // namespace gestell::coupling

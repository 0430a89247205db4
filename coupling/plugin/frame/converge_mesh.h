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
 * The first mesh is that of the specification.  Each next one has its elements where the errors of the fields watched
 * are (fem::MeshError, fem::refine()).  The limit of each quantity is extrapolated (extrapolate()); refinement ends as
 * soon as the error of the last mesh against it and the uncertainty of the limit together are within the tolerance for
 * all of them, or where a bound of the options is met: then `stopped` tells which, and the statement holds for what was
 * reached.
 *
 * The compliance of an interface is the largest displacement of its node [m] under a unit force [N] of any direction,
 * of a floating frame under forces in balance: the largest eigenvalue of the node's block of S^+, S = C*_11.
 *
 * @throws std::invalid_argument for options out of range, a mesh file (it cannot be refined), wrong input of the frame.
 */
MeshConvergence converge_mesh(fem::FrameSpecification specification, const ReductionOptions &reduction,
                              const ConvergenceOptions &options, const Progress &progress = {});

} // namespace gestell::coupling

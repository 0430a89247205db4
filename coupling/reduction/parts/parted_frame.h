#pragma once

#include "coupling/reduction/parts/parts_call.h"
#include "coupling/reduction/reduce_frame.h"
#include "fem/assembly/cell_parts.h"
#include "fem/values/frame_matrices.h"

#include <algorithm>
#include <string>

namespace gestell::coupling
{

/**
 * Reduces a frame that is cut into parts: each part to its interface and its fixed-interface modes, their sum once more
 * by the method in `options`.  Each part is reduced in a child process, so that its memory goes back to the system, and
 * is found in the cache when the frame is reduced again (stored_part()); the result does not depend on either.  The
 * coordinates of several parts and those of the mechanism are the interface of a part, all of them exact.  Neither the
 * matrices of the frame nor a factor of them are stored.  A statement gives the first-order bound of the error of the
 * truncated modes of parts.
 *
 * @param frame  M, B, C without the sums over cells.
 * @throws std::invalid_argument if the interface has more coordinates than the interior of the parts, or for a frame
 * beyond buckling; else as reduce_with_basis(); the exception of the first part that fails, which ends the others.
 *
 * Source: Craig & Bampton 1968; docs/theory/substructures.md, "One mesh in parts".
 */
ReducedModel reduce_in_parts(const fem::FrameMatrices &frame, const fem::CellParts &parts,
                             const ReductionOptions &options, const PartsCall &call);

/**
 * Deflection q [n] of such a frame under static loads f [n], C q = f: each part is condensed to its interface in a
 * process of its own, and recovered in another.
 *
 * @throws std::invalid_argument if supports leave the frame free; as reduce_in_parts().
 */
Eigen::VectorXd deflection_in_parts(const fem::FrameMatrices &frame, const fem::CellParts &parts,
                                    const Eigen::VectorXd &f, const PartsCall &call);

/// Memory [byte] of a reduction in parts, docs/theory/substructures.md (11).
struct PartsMemory
{
  double part   = 0.,
         joined = 0.; ///< of the process of the largest part, and of the one with the mesh and the joined parts

  double largest_process() const { return std::max(part, joined); }
};
PartsMemory memory_of_parts(const fem::CellParts &parts, const fem::FrameMatrices &frame, double compactness);

} // namespace gestell::coupling

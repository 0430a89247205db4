#pragma once

#include "coupling/reduction/reduce_frame.h"
#include "fem/assembly/cell_parts.h"
#include "fem/values/frame_matrices.h"

namespace gestell::coupling
{

/**
 * Reduces a frame that is cut into parts: each part to its interface and its fixed-interface modes, their sum once more
 * by the method in `options`.  The coordinates of several parts and those of the mechanism are the interface of a part,
 * all of them exact.  Neither the matrices of the frame nor a factor of them are stored.  A statement gives the first-
 * order bound of the error of the truncated modes of parts.
 *
 * @param frame  M, B, C without the sums over cells; alpha, beta of Rayleigh damping of the cells.
 * @param place  prefix of messages, "press.toml:12: frame".
 * @throws std::invalid_argument if the interface has more coordinates than the interior of the parts; else as
 * reduce_with_basis().
 *
 * Source: Craig & Bampton 1968; docs/theory/substructures.md, "One mesh in parts".
 */
ReducedModel reduce_in_parts(const fem::FrameMatrices &frame, const fem::CellParts &parts, double alpha, double beta,
                             const ReductionOptions &options, const std::string &place, const Progress &progress);

/// Memory [byte] of a reduction in parts, docs/theory/substructures.md (11): of the largest part, or of the sum.
double memory_of_parts(const fem::CellParts &parts, const fem::FrameMatrices &frame, double compactness);

} // namespace gestell::coupling

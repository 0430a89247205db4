#pragma once

#include "coupling/frame/reduction_options.h"
#include "coupling/reduction/parts/parted_frame.h"
#include "fem/recovery/discretisation.h"

#include <string>

namespace gestell::coupling
{

/**
 * The discretised frame about its prestressed state, if specification.prestress is given:
 *
 *     C q0 = f,     C <- C + K(q0),
 *
 * with the geometric stiffness K of the stresses of q0.  A statement gives the buckling factor.  Statics and modes
 * of the result are those of the linearised state; its displacements count from the frame under the given loads, with
 * weight from the unloaded frame.
 *
 * Of a part with given motions of its interfaces (Prestress::interface_motion) C also contains Discretisation::balance,
 * which belongs to no load: subtract it from the reduced stiffness of the interface.
 *
 * @param factor  of C, see make_factor().
 * @throws std::invalid_argument for loads of zero, a frame without supports, or a load beyond buckling;
 *         ConvergenceFailure.
 *
 * Source: docs/theory/prestress.md.
 */
fem::Discretisation discretised(const fem::Mesh &mesh, const fem::FrameSpecification &specification,
                                const std::string &factor, const Progress &progress);

/**
 * Reduces a frame in parts about its prestressed state.  A statement gives the buckling factor in the reduced
 * coordinates, an upper bound (Rayleigh, Ritz).
 *
 * @param frame  without prestress and without its sums over cells; then about the prestressed state.
 * @param parts  of this frame, without prestress.
 * @throws std::invalid_argument as discretised(), beyond buckling with the factor in the reduced coordinates of the
 *         frame without prestress; else as reduce_in_parts().
 */
ReducedModel reduce_prestressed_in_parts(fem::Discretisation &frame, const fem::CellParts &parts, const fem::Mesh &mesh,
                                         const fem::FrameSpecification &specification, const ReductionOptions &options,
                                         const PartsCall &call);

} // namespace gestell::coupling

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

/// The same of a frame in parts, without its sums over cells; C and M of its parts follow from its mesh_error.
/// @param linear, parts  without prestress.
fem::Discretisation discretised_in_parts(const fem::Discretisation &linear, const fem::CellParts &parts,
                                         const fem::Mesh &mesh, const fem::FrameSpecification &specification,
                                         const PartsCall &call);

/// Adds the buckling factor of a frame in parts: that of its reduced coordinates, an upper bound (Rayleigh, Ritz).
/// @param frame, parts  about the prestressed state.
void add_buckling_bound(ReducedModel &reduced, const fem::Discretisation &frame, const fem::CellParts &parts,
                        const std::string &place);

} // namespace gestell::coupling

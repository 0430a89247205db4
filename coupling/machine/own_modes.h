#pragma once

#include "coupling/frame/reduced_frame.h"

#include <optional>

namespace gestell::coupling
{

/**
 * The modes of a reduced frame whose damping is diagonal in them, as modal damping of the supported frame is, in the
 * coordinates (q1, eta_b) of in_own_modes(). With eta_a, as many modes as q1 has coordinates,
 *
 *     eta_a = S q1 - R eta_b,     S = Phi_1a^-1,   R = S Phi_1b,
 *
 * each of M, B, C and A = w_M M + w_B B + w_C C is diag(D_a, D_b) of the modes, D = w_M + w_B d + w_C omega^2:
 *
 *     A = [ S^T D_a S          -S^T D_a R       ]
 *         [-R^T D_a S     D_b + R^T D_a R       ]
 *
 * so that products and solutions cost O(n1 m), not the O((n1 + m)^2) of full damping between fixed-interface modes.
 */
struct OwnModes
{
  Eigen::MatrixXd S, R;             ///< [n1 x n1], [n1 x m]
  Eigen::VectorXd damping, squares; ///< [n1 + m] d [1/s] and omega^2 of a, then of b
};

/// Turns a frame to its own modes if steps are cheaper there: damping couples its many fixed-interface modes, and is
/// diagonal in its own. Interface coordinates stay. Turning twice changes nothing but rounding. Returns the modes, or
/// nothing if it is left as it is.
std::optional<OwnModes> turn_to_own_modes(ReducedFrame &frame);

/// Coordinates (q1, z) of fixed-interface modes, p = T (q1, z), of a frame in others.
struct FixedModeCoordinates
{
  Eigen::MatrixXd T, inverse; ///< [(n1 + m) x (n1 + m)], or empty: the frame is in them already
  Eigen::VectorXd omega;      ///< [m, rad/s]
};

FixedModeCoordinates fixed_mode_coordinates(const ReducedFrame &frame);

} // namespace gestell::coupling

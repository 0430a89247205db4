#pragma once

#include "coupling/frame/reduced_frame.h"

#include <optional>

namespace gestell::coupling
{

/**
 * The modes of a reduced frame whose damping is diagonal in them, as modal damping of the supported frame is, but for a
 * few dampers, in the coordinates (q1, eta_b) of turn_to_own_modes().  With eta_a, as many modes as q1 has coordinates,
 * and the velocities G^T eta' that the dampers resist,
 *
 *     eta_a = S q1 - R eta_b,     S = Phi_1a^-1,   R = S Phi_1b,
 *
 * each of M, B, C and A = w_M M + w_B B + w_C C is diag(D_a, D_b), D = w_M + w_B d + w_C omega^2, of a and b:
 *
 *     A = [ S^T D_a S          -S^T D_a R       ]
 *         [-R^T D_a S     D_b + R^T D_a R       ]
 *
 * so that products and solutions cost O(n_a m), not the O((n1 + m)^2) of full damping between fixed-interface modes.  A
 * damper is one more row of S and R, a mode a without mass and stiffness: B = diag(d) + G G^T.
 */
struct OwnModes
{
  Eigen::MatrixXd S, R;                     ///< [n_a x n1], [n_a x m]; n_a = n1 + dampers
  Eigen::VectorXd masses, damping, squares; ///< [n_a + m] 1 or 0, d [1/s] and omega^2 of a, then of b
};

/// Turns a frame to its own modes if steps are cheaper there: damping couples its many fixed-interface modes, and is
/// diagonal in its own but for a few dampers. Interface coordinates stay. Turning twice changes nothing but rounding.
/// Returns the modes, or nothing if it is left as it is.
std::optional<OwnModes> turn_to_own_modes(ReducedFrame &frame);

/// Coordinates (q1, z) of fixed-interface modes, p = T (q1, z), of a frame in others.
struct FixedModeCoordinates
{
  Eigen::MatrixXd T, inverse; ///< [(n1 + m) x (n1 + m)], or empty: the frame is in them already
  Eigen::VectorXd omega;      ///< [m, rad/s]
};

FixedModeCoordinates fixed_mode_coordinates(const ReducedFrame &frame);

} // namespace gestell::coupling

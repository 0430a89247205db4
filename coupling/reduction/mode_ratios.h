#pragma once

#include "coupling/frame/reduced_frame.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace gestell::coupling
{

/// Modes of a frame where its displacements are known.
struct ModesAtPoints
{
  Eigen::VectorXd                    omega;    // [p] ascending [rad/s]; rigid-body modes 0
  std::vector<std::array<double, 3>> points{}; ///< [m], or none
  Eigen::MatrixXd                    shapes{}; // [3 points x p]
};

/**
 * The ratios with a number for every measured mode: that of the elastic mode of the frame with the largest
 *
 *     MAC = |a^H b|^2 / (a^H a  b^T b)
 *
 * of the measured shape a and its own b at the nearest points of the frame, among the modes within 30 % of the measured
 * frequency; of the nearest frequency within 20 % if there is no shape, or if it has fewer values than modes to compare
 * or a point farther from all points of the frame than a fiftieth of its size.
 *
 * @param statements  receives a line for each pair
 * @throws std::invalid_argument with the place of a number beyond the modes, an interval without a mode, a measured
 *         mode without a counterpart (with the MAC of those near it), and two ratios of one mode
 *
 * Source: Allemang, Sound and Vibration 37(8), 2003, 14-23 (MAC).
 */
fem::ModalRatios matched(fem::ModalRatios ratios, const ModesAtPoints &modes, std::vector<std::string> &statements);

/**
 * The modal dampers d [1/s] of ratios that are matched, in addition to the damping B = Phi^T B Phi of the modes:
 * 2 zeta omega, and for modes with a ratio of their own what is missing to it, so that the roots of
 *
 *     (s^2 E + s (B + diag(d)) + diag(omega^2)) y = 0
 *
 * that belong to them have s = |s| (-zeta +- i sqrt(1 - zeta^2)), the coupling by B included.
 *
 * @param omega  ascending [rad/s]; rigid-body modes 0
 * @throws std::invalid_argument with the place of a ratio below what B alone gives its mode
 *
 * Source: docs/theory/reduction.md (10b).
 */
Eigen::VectorXd modal_dampers(const fem::ModalRatios &ratios, const Eigen::VectorXd &omega, const Eigen::MatrixXd &B);

/**
 * Adds modal damping to a reduced or small frame, on its own modes, (C* - omega^2 M*) phi = 0 with Phi^T M* Phi = E:
 *
 *     B* += M* Phi diag(d) Phi^T M*
 *
 * Modes with a ratio of their own then have exactly this in `gestell modes`; to all others 2 zeta omega is added,
 * beside the dampers in B*.  Matches of measured modes become statements of the frame.
 * @throws std::invalid_argument as matched() and modal_dampers() do
 *
 * Source: docs/theory/reduction.md (10).
 */
void add_modal_damping(ReducedFrame &frame, const fem::ModalRatios &ratios);

} // namespace gestell::coupling

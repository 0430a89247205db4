#pragma once

#include "apps/output/values/run_story.h"
#include "apps/session/prepared_machine.h"

#include <vector>

namespace gestell::apps
{

/**
 * Vibration through play, cycle by cycle, beside the estimate by harmonic linearisation.  A cycle lies between two
 * events of one kind of an element that can be open; in it the element's own signal (compression, displacement) s moves
 * between s_min and s_max, with A = (s_max - s_min)/2 about (s_max + s_min)/2.  Along the element's part d of the mode
 * v with most of its strain, kappa = k_eq(A) / (d^T K_e d) is its describing function over its engaged stiffness, and
 *
 *     (diag(omega_j^2) + (kappa - 1) V^T K_e V - omega^2 E) y = 0
 *
 * in the modes V of the closed machine gives the frequency beside that of the cycle, 1/duration.
 *
 * Cycles over rows farther apart than a twentieth of them are left out, and those in which the element is loaded on one
 * side of its play only.
 *
 * Source: describing functions, docs/theory/periodic.md; Dresig, Vul'fson, 5.5.5.
 * @param q  where the modes are found
 */
std::vector<PlayEstimate> play_estimates(const std::vector<coupling::Signal> &signals, coupling::Machine &machine,
                                         const Eigen::VectorXd &q, const Result &result);

} // namespace gestell::apps

#pragma once

#include "apps/output/values/run_story.h"
#include "apps/session/prepared_machine.h"

#include <vector>

namespace gestell::apps
{

/**
 * Compares vibration with clearance, cycle by cycle, with its estimate by harmonic linearisation.  A cycle is the time
 * between two events of one kind of an element that can be open; in it the element's signal s (compression,
 * displacement) varies between s_min and s_max, with amplitude A = (s_max - s_min)/2 and mean (s_max + s_min)/2.  For
 * the element's part d of the mode v with most of its strain energy, kappa = k_eq(A) / (d^T K_e d) is the ratio of its
 * describing function to its engaged stiffness, and
 *
 *     (diag(omega_j^2) + (kappa - 1) V^T K_e V - omega^2 E) y = 0
 *
 * in the modes V of the closed machine gives the estimated frequency, to be compared with 1/duration of the cycle.
 *
 * Cycles with fewer than twenty output rows are skipped, as are cycles in which the element is loaded only on one side
 * of its clearance.
 *
 * Source: describing functions, docs/theory/periodic.md; Dresig, Vul'fson, 5.5.5.
 * @param q  configuration of the modes
 */
std::vector<PlayEstimate> play_estimates(const std::vector<coupling::Signal> &signals, coupling::Machine &machine,
                                         const Eigen::VectorXd &q, const Result &result);

} // namespace gestell::apps
